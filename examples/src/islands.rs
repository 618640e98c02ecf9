//! Who sleeps: bodies that touch one another fall asleep together, and wake together.
//!
//! An island is what hangs together by contacts of bodies that pushes can move; scenery joins nobody (Catto,
//! "Simulation islands", box2d.org, 2023, of which this is the plain form: a union-find over each step's contacts
//! (Tarjan, 1975), with the least number for the root, so that nothing depends on an order of visits).

/// Slower than this, in m/s of any point, a body may sleep.
const CALM: f64 = 0.05;
/// An island sleeps when all of it has been calm for so many seconds.
const CALM_FOR: f64 = 0.5;

/// The islands of one game, by the numbers of its bodies.
#[derive(Default)]
pub(crate) struct Islands {
    /// Of an island's body, another of the same island with a lower number, or itself. Of a sleeping body: the root.
    parents: Vec<u32>,
    /// Seconds that each body has been calm; of a root, while islands are joined, the least of its island.
    calm: Vec<f64>,
    /// Ascending.
    pub(crate) asleep: Vec<u32>,
    /// Roots of the islands that are to wake.
    waking: Vec<u32>,
}

impl Islands {
    pub(crate) fn add_body(&mut self) {
        self.parents.push(self.parents.len() as u32);
        self.calm.push(0.0);
    }

    /// Notes how fast a body is that is awake; to be followed by what joins it to others.
    pub(crate) fn note(&mut self, body: u32, speed_squared: f64, seconds: f64) {
        let calm = &mut self.calm[body as usize];
        *calm = if speed_squared < CALM * CALM { *calm + seconds } else { 0.0 };
        self.parents[body as usize] = body;
    }

    /// Something that never rests touches the body.
    pub(crate) fn disturb(&mut self, body: u32) {
        self.calm[body as usize] = 0.0;
    }

    /// Two bodies that are awake touch.
    pub(crate) fn join(&mut self, one: u32, other: u32) {
        let (one, other) = (self.root(one), self.root(other));
        let (low, high) = (one.min(other), one.max(other));
        self.parents[high as usize] = low;
        self.calm[low as usize] = self.calm[low as usize].min(self.calm[high as usize]);
    }

    /// Moves bodies of islands that are calm from the list of those awake to that of those asleep, and tells of each.
    pub(crate) fn send_to_sleep(&mut self, awake: &mut Vec<u32>, mut tell: impl FnMut(u32)) {
        awake.retain(|&body| {
            let root = self.root(body);
            let sleeps = self.calm[root as usize] >= CALM_FOR;
            if sleeps {
                // No longer a chain: a root may be asked for while its island sleeps.
                self.parents[body as usize] = root;
                self.asleep.push(body);
                tell(body);
            }
            !sleeps
        });
        self.asleep.sort_unstable();
    }

    /// The island of a sleeping body is to wake.
    pub(crate) fn rouse(&mut self, body: u32) {
        let root = self.root(body);
        self.waking.push(root);
    }

    /// Moves bodies of islands that are to wake from the list of those asleep to that of those awake, and tells of
    /// each. Returns whether there were any.
    pub(crate) fn wake(&mut self, awake: &mut Vec<u32>, mut tell: impl FnMut(u32)) -> bool {
        if self.waking.is_empty() {
            return false;
        }
        self.waking.sort_unstable();
        self.waking.dedup();
        let [mut asleep, mut waking] = [&mut self.asleep, &mut self.waking].map(core::mem::take);
        asleep.retain(|&body| {
            let wakes = waking.binary_search(&self.root(body)).is_ok();
            if wakes {
                self.calm[body as usize] = 0.0;
                awake.push(body);
                tell(body);
            }
            !wakes
        });
        awake.sort_unstable();
        waking.clear();
        (self.asleep, self.waking) = (asleep, waking);
        true
    }

    fn root(&mut self, body: u32) -> u32 {
        let mut at = body;
        while self.parents[at as usize] != at {
            let up = self.parents[at as usize];
            self.parents[at as usize] = self.parents[up as usize];
            at = up;
        }
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_island_sleeps_when_its_last_body_is_calm_and_wakes_as_a_whole() {
        let mut islands = Islands::default();
        (0..5).for_each(|_| islands.add_body());
        let mut awake = vec![0, 1, 2, 3, 4];
        let mut slept = Vec::new();
        let mut step = |islands: &mut Islands, awake: &mut Vec<u32>, restless: Option<u32>| {
            for &body in &*awake {
                islands.note(body, if restless == Some(body) { 1.0 } else { 0.0 }, 0.3);
            }
            // 1 - 3 - 4 hang together.
            if awake.contains(&1) {
                islands.join(4, 3);
                islands.join(3, 1);
            }
            islands.send_to_sleep(awake, |body| slept.push(body));
        };
        step(&mut islands, &mut awake, None);
        assert_eq!(awake, [0, 1, 2, 3, 4], "it takes half a second");
        step(&mut islands, &mut awake, Some(4));
        assert_eq!((&*awake, &*islands.asleep), (&[1, 3, 4][..], &[0, 2][..]));
        step(&mut islands, &mut awake, None);
        step(&mut islands, &mut awake, None);
        assert_eq!((&*awake, &*islands.asleep), (&[][..], &[0, 1, 2, 3, 4][..]));
        islands.rouse(4);
        let mut woken = Vec::new();
        assert!(islands.wake(&mut awake, |body| woken.push(body)));
        assert_eq!((woken, &*awake, &*islands.asleep), (vec![1, 3, 4], &[1, 3, 4][..], &[0, 2][..]));
        assert_eq!(slept, [0, 2, 1, 3, 4]);
        assert!(!islands.wake(&mut awake, |_| ()));
    }
}
