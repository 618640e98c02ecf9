//! Programs reject wrong options: they fail, with a message that says why.

#![allow(clippy::unwrap_used, reason = "a test that cannot start a program must stop")]

use std::process::Command;

/// The message of a program that fails.
fn complaint(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).output().unwrap();
    assert!(!output.status.success(), "{arguments:?} is taken");
    assert!(output.stdout.is_empty(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn a_folder_without_rows_is_no_report() {
    let said = complaint(env!("CARGO_BIN_EXE_report"), &["--from", "no/such/folder"]);
    assert!(said.contains("no rows in no/such/folder"), "{said}");
}

#[test]
fn rows_that_are_not_there_are_not_compared() {
    let parts = [
        &["narrow"][..],
        &["shapes"],
        &["mesh"],
        &["world"],
        &["world", "--threads", "2"],
        &["certain"],
        &["broad"],
        &["broad", "--threads", "2"],
        &["broad", "--hurt"],
    ];
    for part in parts {
        let said =
            complaint(env!("CARGO_BIN_EXE_compare"), &[part, &["--quick", "--only", "no/such"]].concat());
        assert!(said.contains("no row has") && said.contains("no/such"), "{part:?}: {said}");
    }
}
