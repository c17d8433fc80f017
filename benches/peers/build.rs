//! Refuses to build a Box2D that would be timed with its assertions on.

fn main() {
    println!("cargo:rerun-if-env-changed=CFLAGS");
    let flags = std::env::var("CFLAGS").unwrap_or_default();
    assert!(
        flags.split_whitespace().any(|flag| flag == "-DNDEBUG"),
        "CFLAGS lacks -DNDEBUG: start cargo in benches/peers, whose .cargo/config.toml sets it"
    );
}
