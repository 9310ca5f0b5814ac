// Links libcarom, from the folder CAROM_LIB_DIR if it is set, else from where the linker looks.
fn main() {
    println!("cargo:rerun-if-env-changed=CAROM_LIB_DIR");
    if let Ok(folder) = std::env::var("CAROM_LIB_DIR") {
        println!("cargo:rustc-link-search=native={folder}");
    }
    println!("cargo:rustc-link-lib=dylib=carom");
}
