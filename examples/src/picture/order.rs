//! Which bodies hide which: the engine can answer that as well.
//!
//! Two bodies can hide one another only if their outlines overlap on the screen: those are the contacts of a [`World2`]
//! of outlines. For such a pair, an axis that separates the bodies in space says which one is nearer. Any order that
//! respects every such answer is a valid drawing order (Newell, Newell and Sancha, "A solution to the hidden surface
//! problem", 1972, with whole convex bodies for faces).

use asunder::glam::{DVec2, DVec3};
use asunder::{Collider2, Collider3, Pair3, Polygon, Separation3, World2};
use core::cmp::Reverse;
use std::collections::BinaryHeap;

/// The numbers of the bodies, those furthest from the viewer first.
pub(super) fn far_to_near(
    bodies: &[&Collider3],
    outlines: &[Vec<DVec2>],
    toward_viewer: DVec3,
) -> Vec<usize> {
    let mut nearer: Vec<Vec<usize>> = vec![Vec::new(); bodies.len()];
    let mut hides: Vec<usize> = vec![0; bodies.len()];
    for (a, b) in overlapping(outlines) {
        let (back, front) = match is_nearer(bodies[a], bodies[b], toward_viewer) {
            Some(true) => (b, a),
            Some(false) => (a, b),
            None => continue,
        };
        nearer[back].push(front);
        hides[front] += 1;
    }
    let depth = |body: &Collider3| {
        let pose = body.pose();
        pose.transform(body.shape().center()).dot(toward_viewer)
    };
    let mut by_depth: Vec<usize> = (0..bodies.len()).collect();
    by_depth.sort_by(|&a, &b| depth(bodies[a]).total_cmp(&depth(bodies[b])));
    let mut rank = vec![0; bodies.len()];
    by_depth.iter().enumerate().for_each(|(i, &body)| rank[body] = i);
    sorted(&by_depth, &rank, &nearer, hides)
}

/// A topological sort: next comes a body that hides nothing still to be drawn; of several, the furthest.
fn sorted(by_depth: &[usize], rank: &[usize], nearer: &[Vec<usize>], mut hides: Vec<usize>) -> Vec<usize> {
    let mut is_drawn = vec![false; by_depth.len()];
    let mut order = Vec::with_capacity(by_depth.len());
    let mut ready: BinaryHeap<Reverse<usize>> =
        by_depth.iter().filter(|&&body| hides[body] == 0).map(|&body| Reverse(rank[body])).collect();
    let mut next_stuck = 0;
    while order.len() < by_depth.len() {
        let body = match ready.pop() {
            Some(Reverse(rank)) => by_depth[rank],
            None => {
                // A cycle of bodies, each in front of the next: no order is right, so the furthest goes first.
                next_stuck += 1;
                by_depth[next_stuck - 1]
            }
        };
        if std::mem::replace(&mut is_drawn[body], true) {
            continue;
        }
        order.push(body);
        for &front in &nearer[body] {
            hides[front] = hides[front].saturating_sub(1);
            if hides[front] == 0 && !is_drawn[front] {
                ready.push(Reverse(rank[front]));
            }
        }
    }
    order
}

/// Pairs of bodies whose outlines overlap on the screen.
fn overlapping(outlines: &[Vec<DVec2>]) -> Vec<(usize, usize)> {
    let mut world = World2::new();
    for (number, outline) in outlines.iter().enumerate() {
        let corners: Vec<_> = outline.iter().map(|corner| corner.as_vec2()).collect();
        if let Ok(polygon) = Polygon::hull_of(&corners) {
            world.insert(Collider2::new(polygon).user_data(number as u64));
        }
    }
    world.update();
    let number = |key| world.get(key).map(|body| body.get_user_data() as usize);
    world.contacts().filter_map(|contact| Some((number(contact.a)?, number(contact.b)?))).collect()
}

/// Whether the first of two bodies is nearer; `None` where neither can hide the other.
fn is_nearer(a: &Collider3, b: &Collider3, toward_viewer: DVec3) -> Option<bool> {
    let pair = Pair3::new(a.shape(), a.pose(), b.shape(), b.pose());
    let Separation3::Measured(measured) = pair.separation(f32::MAX) else { return None };
    let rising = measured.normal.as_dvec3().dot(toward_viewer);
    if rising.abs() < 1e-4 { None } else { Some(rising < 0.0) }
}
