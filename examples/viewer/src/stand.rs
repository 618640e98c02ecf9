//! What a game looks like on the screen: bodies as triangles, and lines over them.

use crate::batch::{Batch, Lines};
use crate::form::Form;
use crate::paint::Paint;
use crate::sight::Sight;
use crate::toggles::{Layer, Toggles};
use crate::view::View;
use asunder::glam::{DVec2, DVec3};
use asunder::{AnyWorld, Collider, DebugLine, DebugOptions, Tier};
use asunder_examples::game::Game;
use macroquad::camera::set_camera;
use std::collections::BTreeMap;

/// The most bodies that are drawn: the nearest ones.
const MOST: usize = 40_000;
/// A scene whose half diagonal is more than this many body sizes is not shown whole at first,
const FARTHEST: f64 = 300.0;
/// but only this many body sizes around one body.
const NEAR: f64 = 30.0;
/// The eye sends rays to a lattice of this many points along each side of the scene, to find what hides it.
const RAYS: usize = 5;
/// Large scenery that at least this many of them hit is left out.
const HIDES: usize = 3;

/// How a game is drawn.
pub(crate) struct Stand<S: Sight> {
    forms: Vec<Form>,
    /// Forms by shape, for shapes that many bodies may share.
    known: BTreeMap<[u64; 3], u32>,
    /// Forms by body number.
    form_of: Vec<Option<u32>>,
    /// Whether a body is driven, by number.
    driven: Vec<bool>,
    /// The box around the bodies that pushes could move at the start, and that box with the driven bodies.
    room: (DVec3, DVec3),
    bounds: (DVec3, DVec3),
    /// The typical size of the moving bodies, in metres.
    size: f64,
    solid: Batch,
    glass: Batch,
    thin: Lines,
    over: Lines,
    /// Keys of scenery that is left out, ascending.
    hidden: Vec<S::Key>,
    tiers: Tiers,
    left_out: usize,
}

/// The tiers that decided the contacts of a step.
#[derive(Default)]
struct Tiers {
    /// The step.
    step: Option<u32>,
    /// For each body, by number, the highest tier of its contacts.
    of_body: Vec<Option<Tier>>,
    marks: Vec<(DVec3, Tier)>,
    counts: [usize; 3],
}

impl<S: Sight> Stand<S> {
    pub(crate) fn new(game: &Game<S>, moved: Vec<usize>, closed: (DVec3, DVec3)) -> Self {
        let mut driven = vec![false; game.len()];
        moved.into_iter().filter_map(|number| driven.get_mut(number).map(|is| *is = true)).count();
        let mut stand = Self {
            forms: Vec::new(),
            known: BTreeMap::new(),
            form_of: vec![None; game.len()],
            driven,
            room: (DVec3::ZERO, DVec3::ZERO),
            bounds: (DVec3::ZERO, DVec3::ZERO),
            size: 1.0,
            solid: Batch::default(),
            glass: Batch::default(),
            thin: Lines::default(),
            over: Lines::default(),
            hidden: Vec::new(),
            tiers: Tiers::default(),
            left_out: 0,
        };
        stand.measure(game, closed);
        stand
    }

    /// Finds the box around what moves, with the room that is never left; where nothing moves, around all bounded
    /// bodies.
    fn measure(&mut self, game: &Game<S>, (low, high): (DVec3, DVec3)) {
        let is_driven = |key| game.stepper.number(key).is_some_and(|number| self.is_driven(number));
        let bodies = || game.stepper.world.iter().filter(|(_, body)| S::ball(body).1.is_finite());
        let free = || bodies().filter(|(key, body)| !body.is_fixed() && !is_driven(*key));
        let around = most(free().map(|(_, body)| S::corners(body)).collect());
        let driven: Vec<_> =
            bodies().filter(|(key, _)| is_driven(*key)).map(|(_, body)| S::corners(body)).collect();
        let driven = match around {
            Some(inside) => turning(&driven, inside),
            None => driven.into_iter().reduce(both),
        };
        let all = || bodies().map(|(_, body)| S::corners(body)).reduce(both);
        let Some(room) = around.or(driven).or_else(all) else { return };
        let (sum, count) =
            free().fold((0.0, 0.0), |(sum, count), (_, body)| (sum + S::ball(body).1, count + 1.0));
        let size = if sum > 0.0 { sum / count } else { room.0.distance(room.1) * 0.05 };
        let mut bounds = driven.map_or(room, |driven| both(room, driven));
        if low.is_finite() && high.is_finite() {
            // Where bodies will go in a closed room; they seldom go up.
            bounds = both(bounds, (low, DVec3::new(high.x, high.y.min(bounds.1.y), high.z)));
        }
        if bounds.0.distance(bounds.1) > 2.0 * FARTHEST * size {
            // A world too large for its bodies to be seen from outside: show the surroundings of one near the middle.
            let middle = (bounds.0 + bounds.1) * 0.5;
            let centers = free().map(|(_, body)| S::ball(body).0);
            let near = centers.min_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)));
            let reach = DVec3::splat(NEAR * size);
            bounds = near.map_or(bounds, |near| (bounds.0.max(near - reach), bounds.1.min(near + reach)));
        }
        (self.room, self.bounds, self.size) = (room, bounds, size);
    }

    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        self.bounds
    }

    /// The scenery that is not drawn.
    pub(crate) fn hidden(&self) -> &[S::Key] {
        &self.hidden
    }

    /// Whether a body is driven.
    pub(crate) fn is_driven(&self, number: usize) -> bool {
        self.driven.get(number).is_some_and(|&is| is)
    }

    /// A note to be shown besides the counts.
    pub(crate) fn note(&self) -> Option<String> {
        let [bound, double, exact] = self.tiers.counts;
        match (self.left_out, self.tiers.step) {
            (0, None) => None,
            (0, Some(_)) => {
                Some(format!("contacts settled by the bound {bound}, doubles {double}, exactly {exact}"))
            }
            (left_out, _) => Some(format!("{left_out} bodies not drawn: further away")),
        }
    }

    /// Draws the bodies, then the lines over them.
    pub(crate) fn draw(&mut self, game: &Game<S>, view: &View, toggles: &Toggles) {
        self.solid.clear();
        self.glass.clear();
        self.thin.clear();
        self.over.clear();
        if !toggles.shows(Layer::Tiers) {
            self.tiers = Tiers::default();
        } else if self.tiers.step != Some(game.steps()) {
            self.tiers = Tiers::of(game);
        }
        self.cut_away(game, view, toggles.shows(Layer::Cut));
        self.add_bodies(game, view, toggles);
        self.add_lines(game, view, toggles);
        set_camera(&view.lens(!S::FLAT));
        self.solid.draw();
        self.glass.draw();
        self.thin.draw(1.0);
        self.over.draw(1.0);
        if !S::FLAT {
            // Most lines between bodies lie inside the heap, so they are also drawn faintly through the bodies.
            set_camera(&view.lens(false));
            self.over.draw(self.over.share());
        }
    }

    /// Finds the scenery that stands between the eye and the bodies.
    fn cut_away(&mut self, game: &Game<S>, view: &View, is_on: bool) {
        self.hidden.clear();
        if S::FLAT || !is_on {
            return;
        }
        let (low, high) = self.room;
        let large = 0.08 * low.distance(high);
        let (mut counts, mut found) = (BTreeMap::<S::Key, usize>::new(), Vec::new());
        for i in 0..RAYS * RAYS * RAYS {
            let share = |i: usize| 0.1 + 0.8 * (i % RAYS) as f64 / (RAYS - 1) as f64;
            let to = low + (high - low) * DVec3::new(share(i), share(i / RAYS), share(i / RAYS / RAYS));
            S::between(&game.stepper.world, view.eye(), to, &mut found);
            found.iter().for_each(|&key| *counts.entry(key).or_default() += 1);
        }
        for (key, count) in counts {
            let radius = game.stepper.world.get(key).map_or(0.0, |body| S::ball(body).1);
            if count >= HIDES && radius > large {
                self.hidden.push(key);
            }
        }
    }

    fn add_bodies(&mut self, game: &Game<S>, view: &View, toggles: &Toggles) {
        if !toggles.shows(Layer::Fill) {
            return;
        }
        let eye = view.eye();
        let mut seen: Vec<(f64, S::Key, &Collider<S>)> = Vec::new();
        for (key, body) in game.stepper.world.iter().filter(|(_, body)| body.is_enabled()) {
            let (center, radius) = S::ball(body);
            if view.sees(center, radius) && self.hidden.binary_search(&key).is_err() {
                let distance = if S::FLAT { view.target.distance(center) } else { eye.distance(center) };
                seen.push((distance - radius, key, body));
            }
        }
        self.left_out = seen.len().saturating_sub(MOST);
        if self.left_out > 0 {
            seen.select_nth_unstable_by(MOST, |a, b| a.0.total_cmp(&b.0));
            seen.truncate(MOST);
        }
        // In the plane, scenery is drawn below all else.
        for is_fixed in [true, false] {
            for &(_, key, body) in seen.iter().filter(|seen| seen.2.is_fixed() == is_fixed) {
                let Some(number) = game.stepper.number(key) else { continue };
                let paint = self.paint(number, body, toggles);
                let form = self.form(number, body);
                let Some(form) = self.forms.get(form as usize) else { continue };
                let batch = if body.is_sensor() { &mut self.glass } else { &mut self.solid };
                batch.add(form, &S::frame(body, view.target), view, paint);
            }
        }
    }

    fn form(&mut self, number: usize, body: &Collider<S>) -> u32 {
        if let Some(form) = self.form_of.get(number).copied().flatten() {
            return form;
        }
        let endless = self.bounds.0.distance(self.bounds.1).max(10.0 * self.size);
        let next = self.forms.len() as u32;
        let form = match S::likeness(body) {
            Some(likeness) => *self.known.entry(likeness).or_insert(next),
            None => next,
        };
        if form == next {
            self.forms.push(S::form(body, endless));
        }
        if let Some(of_body) = self.form_of.get_mut(number) {
            *of_body = Some(form);
        }
        form
    }

    fn paint(&self, number: usize, body: &Collider<S>, toggles: &Toggles) -> Paint {
        let paint = match (body.is_sensor(), body.is_fixed()) {
            (true, _) => return Paint::SENSOR,
            _ if self.is_driven(number) && body.is_fixed() => Paint::DRIVEN,
            (_, true) => Paint::SCENERY,
            _ if toggles.shows(Layer::Tiers) => {
                let tier = self.tiers.of_body.get(number).copied().flatten();
                tier.map_or(Paint::PALE, Paint::of_tier)
            }
            _ => S::paint(body).varied(number),
        };
        let is_dark = body.is_asleep() && toggles.shows(Layer::Sleep) && !toggles.shows(Layer::Tiers);
        if is_dark { paint.asleep() } else { paint }
    }

    fn add_lines(&mut self, game: &Game<S>, view: &View, toggles: &Toggles) {
        let is_filled = toggles.shows(Layer::Fill);
        let options = DebugOptions {
            shapes: !is_filled || S::FLAT,
            boxes: toggles.shows(Layer::Boxes),
            columns: toggles.shows(Layer::Columns),
            contacts: toggles.shows(Layer::Contacts) && !toggles.shows(Layer::Tiers),
            normals: toggles.shows(Layer::Normals),
            length: (self.size * 0.6) as f32,
            endless: self.bounds.0.distance(self.bounds.1) as f32,
        };
        let Self { thin, over, .. } = self;
        S::lines(&game.stepper.world, &options, &mut |from, to, what| {
            if !view.sees((from + to) * 0.5, 0.5 * from.distance(to)) {
                return;
            }
            match what {
                DebugLine::Contact | DebugLine::Normal => over.add(view, [from, to], what.colour()),
                DebugLine::Box | DebugLine::Column => thin.add(view, [from, to], what.colour()),
                _ if is_filled => thin.add(view, [from, to], Paint::INK.faint(0.55).bytes(1.0)),
                _ => thin.add(view, [from, to], what.colour()),
            }
        });
        if toggles.shows(Layer::Pairs) {
            for (a, b) in game.stepper.world.candidates() {
                let ends = [a, b].map(|key| game.stepper.world.get(key).map(S::ball));
                let [Some((from, _)), Some((to, _))] = ends else { continue };
                if from.is_finite() && to.is_finite() && view.sees((from + to) * 0.5, 0.5 * from.distance(to))
                {
                    over.add(view, [from, to], Paint::PAIR.bytes(1.0));
                }
            }
        }
        let [right, up, _] = view.axes();
        let arms = [right + up, right - up].map(|arm| arm * (self.size * 0.12));
        for &(place, tier) in self.tiers.marks.iter().filter(|(place, _)| view.sees(*place, self.size)) {
            for arm in arms {
                self.over.add(view, [place - arm, place + arm], Paint::of_tier(tier).bytes(0.75));
            }
        }
    }
}

/// The box around boxes. Far outliers, at most one box in a hundred, are left out.
fn most(boxes: Vec<(DVec3, DVec3)>) -> Option<(DVec3, DVec3)> {
    let (mut low, mut high) = boxes.iter().copied().reduce(both)?;
    let few = boxes.len().div_ceil(100);
    for axis in 0..3 {
        let mut ends = [boxes.iter().map(|b| b.0[axis]).collect(), boxes.iter().map(|b| b.1[axis]).collect()];
        ends.iter_mut().for_each(|ends: &mut Vec<f64>| ends.sort_unstable_by(f64::total_cmp));
        let [lows, highs] = ends;
        let (Some(&from), Some(&to)) = (lows.get(few), highs.get(highs.len().saturating_sub(few + 1))) else {
            continue;
        };
        if from < to && to - from < 0.6 * (high[axis] - low[axis]) {
            (low[axis], high[axis]) = (from, to);
        }
    }
    Some((low, high))
}

/// The box around these boxes. If they surround the others, as a drum does, the box of the wheel that they turn in
/// about an axis along z, since their corners will be anywhere on it.
fn turning(driven: &[(DVec3, DVec3)], inside: (DVec3, DVec3)) -> Option<(DVec3, DVec3)> {
    let (low, high) = driven.iter().copied().reduce(both)?;
    let surrounds = (low.cmple(inside.0) & high.cmpge(inside.1)).bitmask() & 0b011 == 0b011;
    if !surrounds {
        return Some((low, high));
    }
    let middle = (low + high) * 0.5;
    let reach =
        |&(low, high): &(DVec3, DVec3)| (low - middle).abs().max((high - middle).abs()).truncate().length();
    let wheel = DVec2::splat(driven.iter().map(reach).fold(0.0, f64::max)).extend(0.0);
    Some(both((low, high), (middle - wheel, middle + wheel)))
}

fn both(a: (DVec3, DVec3), b: (DVec3, DVec3)) -> (DVec3, DVec3) {
    (a.0.min(b.0), a.1.max(b.1))
}

impl Tiers {
    fn of<S: Sight>(game: &Game<S>) -> Self {
        let mut tiers = Self { step: Some(game.steps()), of_body: vec![None; game.len()], ..Self::default() };
        S::tiers(&game.stepper.world, |keys, tier, places| {
            for number in keys.into_iter().filter_map(|key| game.stepper.number(key)) {
                if let Some(highest) = tiers.of_body.get_mut(number) {
                    *highest = (*highest).max(Some(tier));
                }
            }
            if let Some(count) = tiers.counts.get_mut(tier as usize) {
                *count += 1;
            }
            tiers.marks.extend(places.map(|place| (place, tier)));
        });
        tiers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drum_is_framed_with_room_to_turn_and_a_wall_is_not() {
        let inside = (DVec3::splat(-2.0), DVec3::splat(2.0));
        let bar = |x: f64, y: f64| (DVec3::new(x - 3.0, y - 3.0, -1.0), DVec3::new(x + 3.0, y + 3.0, 1.0));
        let (low, high) = turning(&[bar(1.0, 1.0), bar(-1.0, -1.0)], inside).unwrap();
        let corner = 4.0 * 2.0_f64.sqrt();
        assert!((high - DVec3::new(corner, corner, 1.0)).length() < 1e-12 && low == -high, "{low} {high}");
        let wall = bar(9.0, 0.0);
        assert_eq!(turning(&[wall], inside), Some(wall));
        assert_eq!(turning(&[], inside), None);
    }
}
