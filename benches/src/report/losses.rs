//! Losses: where another method is ahead of ours, found in the rows, one sentence each.

use super::kept::KeptRow;
use super::names::{count, dimension, duration, error, number, short, size, words};
use super::palette::{is_ours, look};
use crate::broad::rows::BroadRow;
use crate::error::{ErrorRow, GapRow, StabilityRow, VertexRow};
use crate::world::rows::FrameRow;

/// Distinct keys, in the order of their first occurrence.
pub fn distinct<T, K: PartialEq>(rows: &[T], key: impl Fn(&T) -> K) -> Vec<K> {
    let mut keys: Vec<K> = Vec::new();
    for row in rows {
        let key = key(row);
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys
}

/// Methods that are faster than our certain answers, or than eight of them at once, and have less error; each with its
/// wrong answers. At the end, methods that are only faster.
///
/// ```
/// use asunder_benches::{error::ErrorRow, report::losses};
/// let row = |method: &str, ns: f64, error_p99: f64| ErrorRow {
///     dimension: "3d".into(), group: "far".into(), method: method.into(), pairs: 10, answered: 10, ns,
///     ns_low: ns, ns_high: ns,
///     error_p99, error_max: error_p99, wrong_per_100k: 0.0, refused: 0,
/// };
/// let rows = [row("certain", 100.0, 1e-9), row("textbook-f64", 50.0, 1e-12), row("parry-f32", 20.0, 1e-7)];
/// let said = losses::of_error(&rows);
/// assert!(said.len() == 2 && said[0].contains("textbook f64") && said[0].contains("2.0 times"), "{said:?}");
/// assert!(said[1].contains("3D, far (parry3d, 5.0 times)"), "{said:?}");
/// ```
pub fn of_error(rows: &[ErrorRow]) -> Vec<String> {
    let (mut said, mut faster) = (Vec::new(), Vec::new());
    for (dim, group) in distinct(rows, |row| (row.dimension.clone(), row.group.clone())) {
        let here = || rows.iter().filter(|row| row.dimension == dim && row.group == group);
        let others = || here().filter(|row| !is_ours(&row.method));
        let place = format!("{}, {}", dimension(&dim), words(&group));
        for ours in here().filter(|row| ["certain", "batched-boxes"].contains(&row.method.as_str())) {
            let ahead = others().filter(|row| row.ns < ours.ns && row.error_p99 < ours.error_p99);
            said.extend(ahead.map(|other| format!("{place}: {}", ahead_of(other, ours))));
        }
        let certain = here().find(|row| row.method == "certain");
        let fastest = others().min_by(|a, b| a.ns.total_cmp(&b.ns));
        if let (Some(certain), Some(fastest)) = (certain, fastest)
            && fastest.ns < certain.ns
        {
            let times = short(certain.ns / fastest.ns);
            faster.push(format!("{place} ({}, {times} times)", look(&fastest.method).name));
        }
    }
    if !faster.is_empty() {
        said.push(format!("Faster than asunder, more exact or not: {}.", faster.join("; ")));
    }
    said
}

/// By how much it is ahead, and at what price.
fn ahead_of(other: &ErrorRow, ours: &ErrorRow) -> String {
    let wrong = |row: &ErrorRow| match (row.wrong_per_100k, row.refused) {
        (0.0, 0) => "never wrong".to_string(),
        (wrong, 0) => format!("wrong {} times in 100,000", count(libm::ceil(wrong) as u64)),
        (wrong, refused) => {
            format!("wrong {} times in 100,000, {} refused", count(libm::ceil(wrong) as u64), count(refused))
        }
    };
    format!(
        "{} is {} times as fast as {}, with a 99th percentile of {} ({}) against {} ({}).",
        look(&other.method).name,
        short(ours.ns / other.ns),
        look(&ours.method).name,
        error(other.error_p99),
        wrong(other),
        error(ours.error_p99),
        wrong(ours),
    )
}

/// How often a method of ours was wrong.
pub fn of_gap(rows: &[GapRow]) -> Vec<String> {
    let of = |method: &str| {
        rows.iter()
            .filter(|row| row.method == method)
            .fold((0, 0), |sum, row| (sum.0 + row.wrong, sum.1 + row.pairs))
    };
    let mut said = Vec::new();
    for method in distinct(rows, |row| row.method.clone()).iter().filter(|method| is_ours(method)) {
        let (wrong, pairs) = of(method);
        if wrong > 0 {
            let name = look(method).name;
            said.push(format!("{name} was wrong {} times in {} pairs.", count(wrong), count(pairs)));
        }
    }
    said
}

/// Methods more stable than our certain method, by the 99th percentile and by more than two digits show.
pub fn of_stability(rows: &[StabilityRow]) -> Vec<String> {
    let mut said = Vec::new();
    for (measure, shape) in distinct(rows, |row| (row.measure.clone(), row.shape.clone())) {
        let here = || rows.iter().filter(|row| row.measure == measure && row.shape == shape);
        let ours = here().filter(|row| is_ours(&row.method)).min_by(|a, b| a.p99.total_cmp(&b.p99));
        let other = here().filter(|row| !is_ours(&row.method)).min_by(|a, b| a.p99.total_cmp(&b.p99));
        if let (Some(ours), Some(other)) = (ours, other)
            && other.p99 < ours.p99
            && number(other.p99) != number(ours.p99)
        {
            said.push(format!(
                "{}, {}: {} is steadier than {} (99th percentile {} against {} {}).",
                words(&measure),
                words(&shape),
                look(&other.method).name,
                look(&ours.method).name,
                number(other.p99),
                number(ours.p99),
                ours.unit,
            ));
        }
    }
    said
}

/// The fastest variant of a method on so many threads.
pub fn best<'a>(
    rows: &'a [BroadRow],
    key: (&str, u64, &str),
    clock: &str,
    threads: u64,
) -> Option<&'a BroadRow> {
    let (scene, boxes, method) = key;
    let here = rows.iter().filter(|row| row.scene == scene && row.boxes == boxes && row.method == method);
    here.filter(|row| row.clock == clock && row.threads == threads).min_by(|a, b| a.ns.total_cmp(&b.ns))
}

/// Scenes and sizes at which the peer finds all pairs faster, or a second thread of ours costs time beyond the noise.
pub fn of_broad(rows: &[BroadRow]) -> Vec<String> {
    let mut said = Vec::new();
    for (scene, boxes) in distinct(rows, |row| (row.scene.clone(), row.boxes)) {
        let of = |method| best(rows, (&scene, boxes, method), "thread", 1);
        if let Some(ours) = of("asunder").filter(|row| row.is_cut) {
            let peer = of("parry3d")
                .map_or(String::new(), |peer| format!(" {} takes {}.", peer.variant, duration(peer.ns)));
            let (boxes, spent) = (size(boxes), duration(ours.ns_low));
            said.push(format!("{scene}, {boxes} boxes: asunder was broken off after {spent}.{peer}"));
        } else if let (Some(ours), Some(peer)) = (of("asunder"), of("parry3d"))
            && peer.ns < ours.ns
        {
            let factor = short(ours.ns / peer.ns);
            said.push(format!("{scene}, {} boxes: {} is {factor} times as fast.", size(boxes), peer.variant));
        }
        let on = |threads| best(rows, (&scene, boxes, "asunder"), "wall", threads);
        if let (Some(one), Some(two)) = (on(1), on(2))
            && two.ns_low > one.ns_high
        {
            let factor = short(two.ns / one.ns);
            said.push(format!(
                "{scene}, {} boxes: two threads take {factor} times as long as one.",
                size(boxes)
            ));
        }
    }
    said
}

/// The size at which one curve falls below another: where the two cross, by linear interpolation between logarithms.
///
/// ```
/// let ours = [(1000.0, 20.0), (10_000.0, 100.0)];
/// let theirs = [(1000.0, 10.0), (10_000.0, 200.0)];
/// let at = asunder_benches::report::losses::crossover(&ours, &theirs);
/// assert!(at.is_some_and(|n| (1000.0..10_000.0).contains(&n)));
/// assert_eq!(asunder_benches::report::losses::crossover(&ours, &ours), None);
/// ```
pub fn crossover(ours: &[(f64, f64)], theirs: &[(f64, f64)]) -> Option<f64> {
    let gaps: Vec<(f64, f64)> = ours
        .iter()
        .filter_map(|&(n, a)| {
            let (_, b) = theirs.iter().find(|other| other.0 == n)?;
            Some((libm::log10(n), libm::log10(a) - libm::log10(*b)))
        })
        .collect();
    let change = gaps.windows(2).find(|ends| ends[0].1 * ends[1].1 < 0.0)?;
    let [(n0, d0), (n1, d1)] = [change[0], change[1]];
    Some(libm::exp10(n0 + (n1 - n0) * d0 / (d0 - d1)))
}

/// Scenes in which the peer's frames are faster, on one thread each; and those in which it takes less memory.
pub fn of_frame(rows: &[FrameRow]) -> Vec<String> {
    let mut said = Vec::new();
    for scene in distinct(rows, |row| row.scene.clone()) {
        let of = |method: &str, threads: u64| {
            rows.iter().find(|row| row.scene == scene && row.method == method && row.threads == threads)
        };
        let (Some(ours), Some(peer)) = (of("asunder", 1), of("parry3d", 1)) else { continue };
        if peer.ns < ours.ns {
            let on_two = of("asunder", 2).filter(|two| two.ns < peer.ns);
            let on_two = on_two.map_or("", |_| "; on two threads asunder is ahead");
            said.push(format!(
                "{scene}: lean parry3d takes {} a frame, asunder {}, {} times as long{on_two}.",
                duration(peer.ns),
                duration(ours.ns),
                short(ours.ns / peer.ns),
            ));
        }
    }
    said.extend(of_memory(rows));
    said
}

/// Scenes in which our memory per body is more than the peer's.
fn of_memory(rows: &[FrameRow]) -> Option<String> {
    let scenes: Vec<String> = distinct(rows, |row| row.scene.clone())
        .into_iter()
        .filter_map(|scene| {
            let of = |method: &str| {
                let mut here = rows.iter().filter(|row| row.scene == scene && row.bytes_per_body > 0.0);
                here.find(|row| row.method == method)
            };
            let ratio = of("asunder")?.bytes_per_body / of("parry3d")?.bytes_per_body;
            (ratio > 1.0).then(|| format!("{scene} ({} times)", short(ratio)))
        })
        .collect();
    (!scenes.is_empty()).then(|| format!("More memory a body than lean parry3d: {}.", scenes.join(", ")))
}

/// Rows of `compare` in which the peer takes less time, one sentence per part.
///
/// ```
/// use asunder_benches::report::{KeptRow, losses::of_kept};
/// let row = |part: &str, row: &str, ours, peer| KeptRow {
///     part: part.into(), row: row.into(), ours_ns: Some(ours), peer_ns: Some(peer), ..KeptRow::default()
/// };
/// let said = of_kept(&[row("mesh", "rays/1k", 3.0, 2.0), row("mesh", "a", 1.0, 2.0), row("narrow", "b", 2.0, 1.0)]);
/// assert_eq!(said, ["mesh: parry3d takes less time in `rays/1k` (1.5 times).", "narrow: parry3d takes less time in `b` (2.0 times)."]);
/// ```
pub fn of_kept(rows: &[KeptRow]) -> Vec<String> {
    let of_part = |part: String| {
        let here = rows.iter().filter(|row| row.part == part);
        let ahead = here.filter_map(|row| {
            let ratio = row.ours_ns? / row.peer_ns?;
            (ratio > 1.0).then(|| format!("`{}` ({} times)", row.row, short(ratio)))
        });
        let ahead: Vec<String> = ahead.collect();
        (!ahead.is_empty()).then(|| format!("{part}: parry3d takes less time in {}.", ahead.join(", ")))
    };
    distinct(rows, |row| row.part.clone()).into_iter().filter_map(of_part).collect()
}

/// Numbers of vertices at which another method is faster than the fastest of ours that is never wrong.
pub fn of_vertices(rows: &[VertexRow]) -> Vec<String> {
    let mut said = Vec::new();
    for (dim, operation) in distinct(rows, |row| (row.dimension.clone(), row.operation.clone())) {
        let here: Vec<&VertexRow> =
            rows.iter().filter(|row| row.dimension == dim && row.operation == operation).collect();
        for vertices in distinct(&here, |row| row.vertices) {
            let least = |ours: bool| {
                let rows = here.iter().filter(|row| row.vertices == vertices && is_ours(&row.method) == ours);
                let rows = rows.filter(|row| row.method != "fast");
                rows.min_by(|a, b| a.ns.total_cmp(&b.ns))
            };
            if let (Some(ours), Some(other)) = (least(true), least(false))
                && other.ns < ours.ns
            {
                said.push(format!(
                    "{}, {operation}, {vertices} vertices: {} takes {}, {} {}.",
                    dimension(&dim),
                    look(&other.method).name,
                    duration(other.ns),
                    look(&ours.method).name,
                    duration(ours.ns),
                ));
            }
        }
    }
    said
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxes(method: &str, threads: u64, [ns_low, ns, ns_high]: [f64; 3]) -> BroadRow {
        let clock = if threads == 0 { "thread" } else { "wall" }.to_string();
        let (scene, method, threads) = ("gas".to_string(), method.to_string(), threads.max(1));
        BroadRow {
            scene,
            boxes: 1000,
            variant: method.clone(),
            method,
            threads,
            clock,
            ns_low,
            ns,
            ns_high,
            ..BroadRow::default()
        }
    }

    #[test]
    fn the_best_way_of_each_side_is_compared_and_only_on_one_clock() {
        let ours = [boxes("asunder", 0, [90.0, 100.0, 110.0]), boxes("asunder", 0, [190.0, 200.0, 210.0])];
        let slower = boxes("parry3d", 0, [140.0, 150.0, 160.0]);
        let by_wall = boxes("parry3d", 1, [1.0, 1.0, 1.0]);
        let rows = [&ours[..], &[slower, by_wall]].concat();
        assert!(of_broad(&rows).is_empty(), "{:?}", of_broad(&rows));
        let faster = boxes("parry3d", 0, [40.0, 50.0, 60.0]);
        let said = of_broad(&[&ours[..], &[faster]].concat());
        assert_eq!(said, ["gas, 1k boxes: parry3d is 2.0 times as fast."]);
    }

    #[test]
    fn a_sweep_that_was_broken_off_is_a_loss_whatever_the_peer_takes() {
        let cut = BroadRow { is_cut: true, ..boxes("asunder", 0, [90.0, 100.0, 100.0]) };
        let slower = boxes("parry3d", 0, [140.0, 150.0, 160.0]);
        let said = of_broad(&[cut, slower]);
        assert_eq!(said, ["gas, 1k boxes: asunder was broken off after 90 ns. parry3d takes 150 ns."]);
    }

    #[test]
    fn a_second_thread_costs_time_only_beyond_the_noise() {
        let one = boxes("asunder", 1, [90.0, 100.0, 110.0]);
        let noisy = boxes("asunder", 2, [105.0, 120.0, 130.0]);
        assert!(of_broad(&[one.clone(), noisy]).is_empty());
        let costly = boxes("asunder", 2, [115.0, 120.0, 130.0]);
        assert_eq!(of_broad(&[one, costly]), ["gas, 1k boxes: two threads take 1.2 times as long as one."]);
    }

    fn frame(method: &str, threads: u64, ns: f64) -> FrameRow {
        FrameRow { scene: "pile".to_string(), method: method.to_string(), threads, ns, ..FrameRow::default() }
    }

    #[test]
    fn a_frame_that_is_lost_on_one_thread_is_a_loss_even_if_two_win() {
        let rows = [frame("asunder", 1, 4e6), frame("asunder", 2, 1e6), frame("parry3d", 1, 2e6)];
        let said = of_frame(&rows);
        assert_eq!(
            said,
            [
                "pile: lean parry3d takes 2.0 ms a frame, asunder 4.0 ms, 2.0 times as long; on two threads asunder is ahead."
            ]
        );
        assert!(of_frame(&rows[1..]).is_empty(), "nothing to compare with");
    }

    #[test]
    fn the_fastest_of_both_sides_decides_at_each_number_of_vertices() {
        let row = |method: &str, vertices: u32, ns: f64| VertexRow {
            dimension: "3d".to_string(),
            operation: "boolean".to_string(),
            method: method.to_string(),
            vertices,
            ns,
            ns_low: ns,
            ns_high: ns,
        };
        let rows = [
            row("certain", 8, 100.0),
            row("batched-boxes", 8, 50.0),
            row("parry-f32", 8, 60.0),
            row("fast", 16, 50.0),
            row("certain", 16, 70.0),
            row("parry-f32", 16, 60.0),
        ];
        assert_eq!(of_vertices(&rows), ["3D, boolean, 16 vertices: parry3d takes 60 ns, asunder 70 ns."]);
    }
}
