//! What must not exist: dependencies between the wrong packages, read from `cargo metadata`, and of the examples'
//! stepper; and that paths and sizes in ARCHITECTURE.md are right.

use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

/// What a user of asunder builds; tests, benches and examples are not part of it.
const LIBRARY: [&str; 5] =
    ["asunder", "asunder-geometry", "asunder-broad", "asunder-narrow", "asunder-scenes"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().to_path_buf()
}

/// The workspace as cargo resolves it: names by package id, and the resolved edges.
struct Graph {
    names: BTreeMap<String, String>,
    edges: BTreeMap<String, Vec<(String, BTreeSet<String>)>>,
    /// Dependencies that each workspace member declares, of every kind.
    declared: BTreeMap<String, Vec<String>>,
}

impl Graph {
    fn read() -> Self {
        // For this platform only: other platforms' packages need not have been downloaded to run the tests.
        let metadata =
            cargo(&["metadata", "--format-version", "1", "--locked", "--filter-platform", &host_platform()]);
        let metadata: Value = serde_json::from_str(&metadata).unwrap();
        let members: Vec<&str> = list(&metadata["workspace_members"]).iter().map(text).collect();
        let (mut names, mut declared) = (BTreeMap::new(), BTreeMap::new());
        for package in list(&metadata["packages"]) {
            let (id, name) = (text(&package["id"]), text(&package["name"]));
            names.insert(id.to_owned(), name.to_owned());
            if members.contains(&id) {
                let dependencies = list(&package["dependencies"]).iter();
                declared.insert(name.to_owned(), dependencies.map(|d| text(&d["name"]).to_owned()).collect());
            }
        }
        let mut edges = BTreeMap::new();
        for node in list(&metadata["resolve"]["nodes"]) {
            let leads = list(&node["deps"]).iter().map(|dep| {
                // A kind of null is a normal dependency.
                let kinds = list(&dep["dep_kinds"]).iter();
                let kinds = kinds.map(|kind| kind["kind"].as_str().unwrap_or("normal").to_owned());
                (text(&dep["pkg"]).to_owned(), kinds.collect())
            });
            edges.insert(text(&node["id"]).to_owned(), leads.collect());
        }
        Self { names, edges, declared }
    }

    /// Names of all packages that a package's build needs, including itself. Its tests may need more.
    fn reachable(&self, name: &str) -> BTreeSet<String> {
        let start = self.names.iter().find(|(_, known)| *known == name);
        let mut open: Vec<String> = vec![start.unwrap_or_else(|| panic!("no package {name}")).0.clone()];
        let mut seen: BTreeSet<String> = open.iter().cloned().collect();
        while let Some(id) = open.pop() {
            for (to, kinds) in &self.edges[&id] {
                let is_built = kinds.contains("normal") || kinds.contains("build");
                if is_built && seen.insert(to.clone()) {
                    open.push(to.clone());
                }
            }
        }
        seen.iter().map(|id| self.names[id].clone()).collect()
    }
}

/// The output of cargo in the workspace root.
fn cargo(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO")).args(arguments).current_dir(root()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn host_platform() -> String {
    let version = cargo(&["-vV"]);
    version.lines().find_map(|line| line.strip_prefix("host: ")).unwrap().to_owned()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_else(|| panic!("no text: {value}"))
}

#[test]
fn no_library_crate_can_reach_parry() {
    let graph = Graph::read();
    for parry in ["parry3d", "parry3d-f64"] {
        // The search must be able to find it at all.
        assert!(graph.reachable("asunder-tests").contains(parry));
        for name in LIBRARY {
            assert!(!graph.reachable(name).contains(parry), "{name} reaches {parry}");
        }
    }
}

#[test]
fn only_tests_and_benches_name_parry() {
    let graph = Graph::read();
    let naming: Vec<&str> = graph
        .declared
        .iter()
        .filter(|(_, dependencies)| dependencies.iter().any(|name| name.starts_with("parry")))
        .map(|(name, _)| name.as_str())
        .collect();
    let allowed = ["asunder-benches", "asunder-suite", "asunder-tests"];
    assert!(naming.contains(&"asunder-tests") && naming.iter().all(|n| allowed.contains(n)), "{naming:?}");
}

#[test]
fn dependencies_point_one_way() {
    let graph = Graph::read();
    let reach = |name: &str| -> BTreeSet<String> {
        let mut names = graph.reachable(name);
        names.retain(|known| known.starts_with("asunder") && known != name);
        names
    };
    let of = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<BTreeSet<_>>();
    assert_eq!(reach("asunder-geometry"), of(&[]), "geometry knows nobody");
    assert_eq!(reach("asunder-broad"), of(&["asunder-geometry"]), "broad never sees narrow");
    assert_eq!(reach("asunder-narrow"), of(&["asunder-geometry"]), "narrow never sees broad");
    assert_eq!(reach("asunder"), of(&["asunder-geometry", "asunder-broad", "asunder-narrow"]));
}

#[test]
fn paths_in_the_architecture_page_exist() {
    let page = std::fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let is_path = |span: &&str| {
        let ends = [".rs", ".toml", ".md"].iter().any(|end| span.ends_with(end));
        let is_plain = span.chars().all(|c| c.is_ascii_alphanumeric() || "/._-".contains(c));
        is_plain && (span.contains('/') || ends)
    };
    // Between backticks: every second piece of a line.
    let spans = page.lines().flat_map(|line| line.split('`').skip(1).step_by(2));
    let paths: Vec<&str> = spans.filter(is_path).collect();
    assert!(paths.len() >= 5, "a code map names paths: {paths:?}");
    let missing: Vec<&&str> = paths.iter().filter(|path| !root().join(path).exists()).collect();
    assert!(missing.is_empty(), "named in ARCHITECTURE.md and not there: {missing:?}");
}

#[test]
fn the_readme_shows_the_hello_example_and_names_paths_that_exist() {
    let page = std::fs::read_to_string(root().join("README.md")).unwrap();
    let hello = std::fs::read_to_string(root().join("examples/hello_3d.rs")).unwrap();
    assert!(page.contains(&format!("```rust\n{hello}```")), "README's code is not examples/hello_3d.rs");
    let links = page.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let local: Vec<&str> = links.filter(|link| !link.contains("://")).collect();
    assert!(local.len() >= 4, "README links to pages and a picture: {local:?}");
    let missing: Vec<&&str> = local.iter().filter(|link| !root().join(link).exists()).collect();
    assert!(missing.is_empty(), "named in README.md and not there: {missing:?}");
}

/// Source files of the examples' stepper, without tests: `examples/src/stepper.rs examples/src/stepper/*.rs`.
fn stepper() -> Vec<(PathBuf, String)> {
    let source = root().join("examples/src");
    let parts = std::fs::read_dir(source.join("stepper")).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> =
        parts.filter(|path| path.extension().is_some_and(|end| end == "rs")).collect();
    files.push(source.join("stepper.rs"));
    files.sort();
    files.into_iter().map(|path| (path.clone(), std::fs::read_to_string(path).unwrap())).collect()
}

/// Lines that are neither blank nor comments.
fn code(text: &str) -> impl Iterator<Item = &str> {
    text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//"))
}

#[test]
fn the_stepper_stands_on_the_engine_alone() {
    let files = stepper();
    assert!(files.len() >= 4, "they are found: {files:?}");
    let own = ["body", "dimension", "islands", "solver", "super"].map(|name| format!("{name}::"));
    let is_known = |path: &str| {
        let outside = ["asunder::", "core::", "asunder_scenes::stages::Feel;"];
        outside.iter().any(|start| path.starts_with(start)) || own.iter().any(|start| path.starts_with(start))
    };
    for (path, text) in &files {
        let uses = code(text).filter_map(|line| line.strip_prefix("pub use ").or(line.strip_prefix("use ")));
        let foreign: Vec<&str> = uses.filter(|path| !is_known(path)).collect();
        assert!(foreign.is_empty(), "{}: {foreign:?}", path.display());
        // Paths that need no `use`: the layers above by `crate`, or by a `super` of the whole module.
        let above =
            ["crate::", "super::super", "asunder_examples", "asunder_broad", "asunder_narrow", "libm::"];
        let named: Vec<&str> =
            code(text).filter(|line| above.iter().any(|name| line.contains(name))).collect();
        let is_top = path.ends_with("src/stepper.rs");
        assert!(named.is_empty() && !(is_top && text.contains("super::")), "{}: {named:?}", path.display());
    }
}

#[test]
fn the_stepper_is_as_small_as_the_architecture_page_says() {
    let lines: usize = stepper().iter().map(|(_, text)| code(text).count()).sum();
    // It is meant to be read whole, in both dimensions: about 500 lines were the goal. What needs more belongs in a
    // layer on top of it.
    assert!(lines <= 550, "{lines} lines of code: move to `game` what a stepper can do without");
    let page = std::fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    assert!(page.contains(&format!("The examples' stepper is {lines} lines of code")), "it is {lines} lines");
}
