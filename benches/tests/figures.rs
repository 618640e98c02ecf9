//! README's figures are drawn from `benches/results` alone: drawn again, they are the same bytes.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot read must stop")]

use asunder_benches::report::sections::chapters;
use asunder_benches::report::{Data, page, readme};
use std::path::Path;

const AGAIN: &str = "cargo run --release -p asunder-benches --bin report -- --readme --from";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// README, the folder of data that it names, and the data.
fn read() -> (String, String, Data) {
    let page = std::fs::read_to_string(root().join("README.md")).unwrap();
    let folder =
        readme::data_of(&page).expect("README has the mark figures:begin, with a folder").to_string();
    let data = Data::read(&root().join(&folder)).unwrap();
    (page, folder, data)
}

#[test]
fn readme_says_what_the_data_says() {
    let (page, folder, data) = read();
    let new = readme::spliced(&page, &folder, &readme::part(&data)).expect("README has both marks");
    let first = page.lines().zip(new.lines()).position(|(old, new)| old != new);
    let at = first.map(|line| (line + 1, page.lines().nth(line), new.lines().nth(line)));
    assert!(page == new, "README is not what {folder} says, first in line {at:?}: {AGAIN} {folder}");
}

#[test]
fn checked_in_pictures_are_what_the_data_draws() {
    let (page, folder, data) = read();
    let figures = readme::figures(&data);
    assert!(!figures.is_empty(), "{folder} has rows");
    for figure in &figures {
        let path = format!("{}/{}.svg", readme::FOLDER, figure.file);
        let kept = std::fs::read_to_string(root().join(&path)).unwrap_or_default();
        assert!(kept == figure.svg, "{path} is not what {folder} draws: {AGAIN} {folder}");
        assert!(page.contains(&path), "README does not show {path}");
    }
    let kept = std::fs::read_dir(root().join(readme::FOLDER)).unwrap().count();
    assert_eq!(kept, figures.len(), "{} holds other pictures too", readme::FOLDER);
}

#[test]
fn a_figure_of_the_data_that_changes_changes_the_page() {
    let (_, _, mut data) = read();
    let before = (readme::part(&data), page::to_html(&chapters(&data)));
    assert_eq!(before, (readme::part(&data), page::to_html(&chapters(&data))), "drawing is a function");
    let row = data.frame.iter_mut().find(|row| row.method == "asunder" && row.threads == 1).unwrap();
    row.ns *= 1.5;
    assert_ne!(readme::part(&data), before.0);
    assert_ne!(page::to_html(&chapters(&data)), before.1);
}
