# What CI does.
check:
    bash .ci/run

# README's test command.
test:
    cargo test

# A heap of crates, and its picture.
play:
    cargo run --release --example play -- --svg target/play.svg

# Our time beside parry3d's in one run: broad, narrow or world; certain: what exact answers cost.
compare what="narrow":
    cargo run --release -p asunder-benches --bin compare -- {{ what }} --quick

# Speed against error, in one page: target/report/index.html (eight minutes; --quick: two).
report *options:
    cargo run --release -p asunder-benches --bin report -- {{ options }}

# Criterion benches of another commit, then of this tree beside them, in one place: bench-compare main.
bench-compare base:
    bash benches/compare-commits {{ base }}

# A million hard cases beside parry3d: docs/hard.md.
hard:
    cargo run --release -p asunder-tests --bin hard

# The same bits as WebAssembly (needs `rustup target add wasm32-wasip1`, and Node).
wasm:
    cargo build --release -p asunder --example fingerprints --target wasm32-wasip1
    node crates/asunder/examples/wasi.mjs target/wasm32-wasip1/release/examples/fingerprints.wasm | diff - crates/asunder/examples/fingerprints.txt

# Licences, advisories and sources of all dependencies (needs cargo-deny).
deny:
    cargo deny check
