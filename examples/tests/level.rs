//! The example `level` as a program: bad files are refused with a message, and nothing falls through its own level.
//!
//! `cargo test` builds examples before it runs tests; `cargo test --test level` alone does not.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests stop the test, as tests do")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A triangle's corners, without a face.
const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 0 0 1\n";

/// Where this test may put a file.
fn place(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// Runs the example, with a place of its own for its picture.
fn level(name: &str, arguments: &[&str]) -> Output {
    let deps = std::env::current_exe().unwrap();
    let example = deps.parent().unwrap().parent().unwrap().join("examples/level");
    let example = example.with_extension(std::env::consts::EXE_EXTENSION);
    assert!(example.exists(), "first: cargo build --example level");
    Command::new(example).arg("--svg").arg(place(name)).args(arguments).output().unwrap()
}

/// The example's message about a file, on one line: the file's name, then the reason.
fn refusal(file: &Path) -> String {
    let file = file.to_str().unwrap();
    let output = level("refused.svg", &["--steps", "1", "--bodies", "1", file]);
    assert_eq!(output.status.code(), Some(2), "{file}");
    assert!(output.stdout.is_empty(), "{file}: {output:?}");
    let said = String::from_utf8(output.stderr).unwrap();
    let reason = said.strip_prefix(&format!("level: {file}: ")).unwrap_or_else(|| panic!("{said}"));
    assert_eq!(reason.lines().count(), 1, "{said}");
    reason.trim_end().to_string()
}

#[test]
fn a_bad_file_is_refused_by_its_name_and_the_reason() {
    let with = |lines: &str| format!("{CORNERS}{lines}\n").into_bytes();
    let after = |line: &str| format!("{line}\n{CORNERS}f 1 2 3\n").into_bytes();
    let cases = [
        ("empty", vec![], "no face"),
        ("no face", with(""), "no face"),
        ("two corners", with("f 1 2"), "no face"),
        ("beyond the last", with("f 1 2 4"), "index out of bounds"),
        ("before the first", with("f 1 2 -4"), "index out of bounds"),
        ("number zero", with("f 0 1 2"), "index out of bounds"),
        ("a word", with("f one two three"), "face parse error"),
        ("not a number", after("v 0 nan 0"), "vertex 0 is not finite"),
        ("infinite", after("v inf 0 0"), "vertex 0 is not finite"),
        ("far away", after("v 1e9 0 0"), "more than 1000000 m from"),
        ("two coordinates", after("v 0 0"), "position parse error"),
        ("a line", with("v 2 0 0\nf 1 2 4"), "a triangle that has an area"),
        ("binary", (0..=255).cycle().take(5000).collect(), "not a Wavefront OBJ file"),
        ("zeros", vec![0; 5000], "no face"),
    ];
    for (name, bytes, reason) in cases {
        let file = place(&format!("{name}.obj"));
        std::fs::write(&file, bytes).unwrap();
        let found = refusal(&file);
        assert!(found.contains(reason), "{name}: {found}");
    }
}

#[test]
fn so_is_what_is_no_file() {
    for file in [place("there is no such file.obj"), place(".")] {
        let found = refusal(&file);
        assert!(found.starts_with("not a Wavefront OBJ file that can be read: "), "{found}");
    }
}

/// After four seconds, anything that had fallen through would be tens of metres below, and fast.
#[test]
fn nothing_falls_through_the_level() {
    for (name, more) in [("two.svg", None), ("one.svg", Some("--one-sided"))] {
        let arguments: Vec<&str> = ["--steps", "240", "--bodies", "80"].into_iter().chain(more).collect();
        let output = level(name, &arguments);
        assert!(output.status.success(), "{output:?}");
        let said = String::from_utf8(output.stdout).unwrap();
        let value = |row: &str| said.lines().find_map(|line| line.strip_prefix(row)).map(str::trim_start);
        let bodies = value("bodies ").unwrap();
        assert!(bodies.starts_with("81 (") && bodies.ends_with(" 0 left the level)"), "{said}");
        assert_eq!(value("outside "), None, "{said}");
        // All have landed, and lie on the level.
        let touching = value("contacts ").unwrap().split(['(', ' ']).nth(2).unwrap().parse::<u32>().unwrap();
        assert!(touching >= 80, "{said}");
        assert!(std::fs::read_to_string(place(name)).unwrap().starts_with("<svg"), "{name}");
    }
}
