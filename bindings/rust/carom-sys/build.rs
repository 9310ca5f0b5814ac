// Compiles the library, whose one file this crate has. Where CAROM_LIB_DIR names a folder, links
// libcarom from there instead.
use std::{env, path::Path, process::Command};

fn main() {
    for name in ["CAROM_LIB_DIR", "CC", "AR", "CFLAGS"] {
        println!("cargo:rerun-if-env-changed={name}");
    }
    if let Ok(folder) = env::var("CAROM_LIB_DIR") {
        println!("cargo:rustc-link-search=native={folder}");
        println!("cargo:rustc-link-lib=dylib=carom");
        return;
    }
    println!("cargo:rerun-if-changed=c");
    let out = env::var("OUT_DIR").expect("cargo sets OUT_DIR");
    let (object, library) = (
        Path::new(&out).join("carom.o"),
        Path::new(&out).join("libcarom.a"),
    );
    let mut cc = tool("CC", "cc");
    cc.args(env::var("CFLAGS").unwrap_or_default().split_whitespace());
    cc.args([
        "-std=c17",
        "-O2",
        "-fPIC",
        "-pthread",
        "-Ic",
        "-c",
        "c/carom.c",
        "-o",
    ])
    .arg(&object);
    run(cc);
    let mut ar = tool("AR", "ar");
    ar.arg("crs").args([&library, &object]);
    run(ar);
    println!("cargo:rustc-link-search=native={out}");
    println!("cargo:rustc-link-lib=static=carom");
    if env::var("CARGO_CFG_TARGET_FAMILY").as_deref() == Ok("unix") {
        println!("cargo:rustc-link-lib=m");
    }
}

/// The program that the variable names, or the usual one.
fn tool(variable: &str, usual: &str) -> Command {
    Command::new(env::var(variable).unwrap_or_else(|_| usual.to_string()))
}

fn run(mut command: Command) {
    match command.status() {
        Ok(status) if status.success() => {}
        Ok(status) => panic!("{command:?}: {status}"),
        Err(error) => panic!(
            "{command:?}: {error}; carom needs gcc or clang, which CC names, or CAROM_LIB_DIR"
        ),
    }
}
