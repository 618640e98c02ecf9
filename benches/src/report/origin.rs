//! The origin of figures: command, machine, versions, date.

use super::Section;
use super::cpu::Processor;
use serde::{Deserialize, Serialize};
use std::process::Command;
use std::time::SystemTime;

/// The origin of the figures of one section.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// The section's name.
    pub section: String,
    /// The command that made it.
    pub command: String,
    /// The processor, in words.
    pub cpu: String,
    /// How many cores the program saw.
    pub cores: u64,
    /// `virtual` if the machine is virtual, else empty.
    pub kind: String,
    /// The operating system, and the architecture.
    pub os: String,
    /// Version of asunder.
    pub asunder: String,
    /// Version of parry3d.
    pub parry3d: String,
    /// Version of the compiler.
    pub rustc: String,
    /// The commit, with a plus if files had been changed since; empty if unknown.
    pub commit: String,
    /// The date, as `2026-11-22`.
    pub date: String,
}

impl Origin {
    /// The origin of figures measured now.
    pub fn now(section: Section, processor: &Processor, is_quick: bool) -> Self {
        let quick = if is_quick { " --quick" } else { "" };
        let name = section.name();
        let cores = std::thread::available_parallelism().map_or(1, usize::from) as u64;
        Self {
            section: name.to_string(),
            command: format!("cargo run --release -p asunder-benches --bin report -- --only {name}{quick}"),
            cpu: processor.name.clone(),
            cores,
            kind: if processor.is_virtual { "virtual".to_string() } else { String::new() },
            os: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            asunder: env!("CARGO_PKG_VERSION").to_string(),
            parry3d: locked_version("parry3d").to_string(),
            rustc: said_by("rustc", &["--version"])
                .split_whitespace()
                .nth(1)
                .unwrap_or("unknown")
                .to_string(),
            commit: commit(),
            date: today(),
        }
    }

    /// The machine in one line.
    ///
    /// ```
    /// use asunder_benches::report::origin::Origin;
    /// let (cpu, cores, date) = ("Some CPU".to_string(), 1, "2026-11-22".to_string());
    /// let origin = Origin { cpu, cores, date, ..Origin::default() };
    /// assert!(origin.machine().starts_with("Some CPU, 1 core, "));
    /// ```
    pub fn machine(&self) -> String {
        let kind = if self.kind.is_empty() { String::new() } else { format!("{} ", self.kind) };
        let cores = if self.cores == 1 { "core" } else { "cores" };
        format!("{}, {} {kind}{cores}, {}", self.cpu, self.cores, self.os)
    }

    /// Versions in one line.
    pub fn versions(&self) -> String {
        let Self { asunder, parry3d, rustc, commit, .. } = self;
        let commit = if commit.is_empty() { String::new() } else { format!(" at {commit}") };
        format!("asunder {asunder}{commit}, parry3d {parry3d}, rustc {rustc}")
    }
}

/// The version of a package in this build.
fn locked_version(package: &str) -> &'static str {
    const LOCK: &str = include_str!("../../../Cargo.lock");
    let name = format!("\nname = \"{package}\"\nversion = \"");
    let rest = LOCK.find(&name).map_or("", |at| &LOCK[at + name.len()..]);
    rest.split('"').next().unwrap_or("")
}

/// The commit, with a plus if files were changed since; empty if unknown.
pub(super) fn commit() -> String {
    let git = |arguments: &[&str]| said_by("git", &[&["-C", env!("CARGO_MANIFEST_DIR")], arguments].concat());
    let commit = git(&["rev-parse", "--short=9", "HEAD"]);
    // Rows saved by an earlier run do not change what is measured.
    let changed = git(&["status", "--porcelain", "--", ":/", ":(top,exclude)benches/results"]);
    if changed.is_empty() { commit } else { format!("{commit}+") }
}

/// The output of a program; empty if it cannot be run.
fn said_by(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).output().ok().filter(|output| output.status.success());
    output.map_or_else(String::new, |output| String::from_utf8_lossy(&output.stdout).trim().to_string())
}

/// Today's date, as `2026-11-22`.
pub(super) fn today() -> String {
    day(seconds_since_1970())
}

fn seconds_since_1970() -> u64 {
    SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).map_or(0, |since| since.as_secs())
}

/// The date of a time, by the Gregorian calendar. The algorithm is Howard Hinnant's `civil_from_days`.
fn day(seconds: u64) -> String {
    let days = seconds / 86_400 + 719_468;
    let (era, of_era) = (days / 146_097, days % 146_097);
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    // Months are counted from March, so that a leap day comes last.
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let (month, later) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{day:02}", year + era * 400 + later)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_those_of_the_calendar() {
        let days = [0, 951_782_400, 951_868_800, 1_709_164_800, 1_795_305_600, 4_107_542_400];
        let dates = ["1970-01-01", "2000-02-29", "2000-03-01", "2024-02-29", "2026-11-22", "2100-03-01"];
        assert_eq!(days.map(day), dates);
    }

    #[test]
    fn the_peer_is_in_the_lock_file() {
        assert!(locked_version("parry3d").starts_with("0."), "{}", locked_version("parry3d"));
        assert_eq!(locked_version("no-such-package"), "");
    }
}
