// Compiles the library, which this crate contains as one file. If CAROM_LIB_DIR names a folder,
// links libcarom from there instead.
use std::{env, path::Path, process::Command};

fn main() {
    for name in ["CAROM_LIB_DIR", "CFLAGS"] {
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
    let mut cc = tool("CC");
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
    // Last, so that they may override the flags above.
    cc.args(env::var("CFLAGS").unwrap_or_default().split_whitespace());
    run(cc);
    let mut ar = tool("AR");
    ar.arg("crs").args([&library, &object]);
    run(ar);
    println!("cargo:rustc-link-search=native={out}");
    println!("cargo:rustc-link-lib=static=carom");
    if env::var("CARGO_CFG_TARGET_FAMILY").as_deref() == Ok("unix") {
        println!("cargo:rustc-link-lib=m");
    }
}

/// The compiler or archiver for the target, CC or AR: the program that CC_TARGET names, with the
/// target's dashes or with underscores, or TARGET_CC when cross-compiling, or CC; otherwise the
/// usual one of the target.
fn tool(kind: &str) -> Command {
    let of_cargo = |name: &str| env::var(name).expect("cargo sets TARGET and HOST");
    let (target, host) = (of_cargo("TARGET"), of_cargo("HOST"));
    let mut names = vec![
        format!("{kind}_{target}"),
        format!("{kind}_{}", target.replace('-', "_")),
    ];
    if target != host {
        names.push(format!("TARGET_{kind}"));
    }
    names.push(kind.to_string());
    for name in names {
        println!("cargo:rerun-if-env-changed={name}");
        if let Ok(program) = env::var(&name) {
            return Command::new(program);
        }
    }
    usual_tool(kind, &target, &host)
}

/// cc and ar on this machine; for another one gcc's names, such as aarch64-linux-gnu-gcc, and for
/// Apple and Android clang, which supports all targets.
fn usual_tool(kind: &str, target: &str, host: &str) -> Command {
    if target == host {
        return Command::new(kind.to_lowercase());
    }
    if target.contains("apple") || target.contains("android") {
        if kind == "AR" {
            return Command::new("llvm-ar");
        }
        let mut clang = Command::new("clang");
        clang.arg(format!("--target={target}"));
        return clang;
    }
    let prefix = target.replace("-unknown", "").replace("-pc", "");
    Command::new(match kind {
        "AR" => format!("{prefix}-ar"),
        _ => format!("{prefix}-gcc"),
    })
}

fn run(mut command: Command) {
    match command.status() {
        Ok(status) if status.success() => {}
        Ok(status) => panic!("{command:?}: {status}"),
        Err(error) => panic!(
            "{command:?}: {error}; carom needs gcc or clang for the target, which CC names, or CAROM_LIB_DIR"
        ),
    }
}
