//! Two machines play one game. Inputs arrive late; wrongly predicted frames are rolled back and played again, and both
//! end in the same bits as a machine that had every input in time.

use super::{Stored, assert_equal_texts};
use asunder::glam::{Vec2, Vec3};
use asunder::{
    Chain, Collider, Collider2, Collider3, Event, HeightField, Plane, Pose3, TriMesh, Volume, World,
};
use asunder_tests::cases::Random;
use asunder_tests::engine::Change;
use rayon::{ThreadPool, ThreadPoolBuilder};

const FRAMES: usize = 60;

/// Half of the side of the room, in metres.
const ROOM: f64 = 3.0;

/// Bodies of the level, which stand still and belong to nobody.
trait Level: Stored {
    fn level() -> Vec<Collider<Self>>;
}

impl Level for Volume {
    fn level() -> Vec<Collider<Self>> {
        let height = |number: usize| [0.0, 0.3, -0.2, 0.1, 0.5][number % 5];
        let heights: Vec<f32> = (0..49).map(|number| height(number * number)).collect();
        let field = HeightField::new(7, 7, heights, Vec2::ONE).unwrap().with_hole(2, 3).unwrap();
        let row = |z: f32| (0..6).map(move |x| Vec3::new(x as f32 - 3.0, 0.3 * ((x % 3) as f32 - 1.0), z));
        let strip = (0..5).flat_map(|x| [[x, x + 6, x + 1], [x + 1, x + 6, x + 7]]).collect::<Vec<_>>();
        let mesh = TriMesh::new(row(-2.0).chain(row(2.0)).collect::<Vec<_>>(), strip).unwrap();
        vec![
            Collider3::new(field).at(Pose3::at([-3.0, -2.0, -3.0]).unwrap()),
            Collider3::new(mesh).margin(0.05).unwrap(),
        ]
    }
}

impl Level for Plane {
    fn level() -> Vec<Collider<Self>> {
        let vertices = (0..13).map(|x| Vec2::new(0.5 * x as f32 - 3.0, [0.0, 0.4, -0.1, -0.1][x % 4]));
        vec![Collider2::new(Chain::open(vertices).unwrap())]
    }
}

/// Everything that determines the next frame.
#[derive(Clone)]
struct Game<S: Stored> {
    world: World<S>,
    /// Of all bodies that ever existed, including removed ones.
    keys: Vec<S::Key>,
}

/// What a player does in a frame, given as a seed.
type Input = u128;

/// Players change their inputs every other frame.
fn input_of(player: usize, frame: usize) -> Input {
    (1000 * player + frame / 2) as Input
}

impl<S: Level> Game<S> {
    fn new(bodies: usize) -> Self {
        let mut random = Random::new(1100);
        let mut game = Self { world: World::new(), keys: Vec::new() };
        for ground in S::level() {
            S::insert(&mut game.world, ground);
        }
        for _ in 0..bodies {
            game.insert(&mut random);
        }
        game
    }

    fn insert(&mut self, random: &mut Random) {
        let body = S::random_body(random, ROOM);
        let body = if random.below(3) == 0 { body.bullet() } else { body };
        self.keys.push(S::insert(&mut self.world, body));
    }

    fn act(&mut self, random: &mut Random) {
        let (what, key) = (random.below(16), self.keys[random.below(self.keys.len())]);
        match what {
            0..2 => self.insert(random),
            2 => drop(S::remove(&mut self.world, key)),
            3..7 => _ = S::change(&mut self.world, key, &Change::random(random)),
            7..11 => _ = S::set_pose(&mut self.world, key, S::random_pose(random, ROOM)),
            _ => _ = S::set_motion(&mut self.world, key, S::random_motion(random, 4.0)),
        }
    }

    /// Both players' actions, then an update, and the game's reaction: so that the state saved for a frame contains
    /// motions and moves that no update has processed.
    fn step(&mut self, inputs: [Input; 2]) {
        for input in inputs {
            let random = &mut Random::new(1200 + input);
            (0..6).for_each(|_| self.act(random));
        }
        self.world.update();
        let begun = S::events(&self.world).iter().filter(|event| event.is_began()).map(Event::bodies);
        let hits = S::impacts(&self.world).iter().map(|hit| (hit.bullet, hit.other));
        let (begun, hits) = (begun.collect::<Vec<_>>(), hits.collect::<Vec<_>>());
        for (number, (_, body)) in begun.into_iter().enumerate() {
            S::set_motion(&mut self.world, body, S::shift(0.1 * number as f64 - 0.5));
        }
        for (bullet, other) in hits {
            let Some(pose) = S::get(&self.world, other).map(S::pose_of) else { continue };
            S::set_pose(&mut self.world, bullet, pose);
        }
    }

    /// The output of the last frame, bit for bit: `Debug` distinguishes all numbers.
    fn said(&self) -> [String; 4] {
        let world = &self.world;
        let (candidates, contacts) = (S::candidates(world), S::contacts(world));
        [
            format!("{candidates:?}"),
            format!("{contacts:?}"),
            format!("{:?}", S::events(world)),
            format!("{:?}", S::impacts(world)),
        ]
    }
}

/// The saved state of the game before a frame.
enum Past<S: Stored> {
    Clone(Box<Game<S>>),
    Text(String, Vec<S::Key>),
}

impl<S: Stored> Past<S> {
    fn recall(&self) -> Game<S> {
        match self {
            Self::Clone(game) => Game::clone(game),
            Self::Text(text, keys) => Game { world: S::restored(text).unwrap(), keys: keys.clone() },
        }
    }
}

/// One of the two machines.
struct Machine<S: Stored> {
    player: usize,
    /// Whether it saves clones or text.
    clones: bool,
    threads: ThreadPool,
    past: Vec<Past<S>>,
    now: Game<S>,
    /// The output of every frame, from when it was last played.
    said: Vec<[String; 4]>,
    /// The other player's inputs, as far as they are known.
    known: Vec<Input>,
    /// Frames that were played again with another output.
    corrected: usize,
}

impl<S: Level> Machine<S> {
    fn new(player: usize, bodies: usize, (clones, threads): (bool, usize)) -> Self {
        let threads = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let (now, past, said, known) = (Game::new(bodies), vec![], vec![], vec![]);
        Self { player, clones, threads, past, now, said, known, corrected: 0 }
    }

    /// The other player's input: the true one, or the last one known.
    fn other(&self, frame: usize) -> Input {
        self.known.get(frame).or(self.known.last()).copied().unwrap_or(0)
    }

    fn play(&mut self, frame: usize) {
        let mut inputs = [input_of(self.player, frame); 2];
        inputs[1 - self.player] = self.other(frame);
        let Self { now, threads, .. } = self;
        self.past.truncate(frame);
        self.past.push(if self.clones {
            Past::Clone(Box::new(now.clone()))
        } else {
            Past::Text(S::text(&now.world), now.keys.clone())
        });
        threads.install(|| now.step(inputs));
        let said = now.said();
        match self.said.get_mut(frame) {
            Some(before) => {
                self.corrected += usize::from(*before != said);
                *before = said;
            }
            None => self.said.push(said),
        }
    }

    /// Receives the other player's next input. If it was predicted wrongly, rolls back to its frame, and plays on to
    /// now.
    fn receive(&mut self, input: Input) {
        let (frame, now) = (self.known.len(), self.past.len());
        let guess = self.other(frame);
        self.known.push(input);
        if frame < now && guess != input {
            self.now = self.past[frame].recall();
            (frame..now).for_each(|again| self.play(again));
        }
    }
}

fn check<S: Level>(bodies: usize, machines: [(bool, usize); 2]) {
    let mut host = Game::<S>::new(bodies);
    let mut most_pairs = 0;
    let truth: Vec<_> = (0..FRAMES)
        .map(|frame| {
            host.step([input_of(0, frame), input_of(1, frame)]);
            most_pairs = most_pairs.max(host.world.stats().candidates);
            host.said()
        })
        .collect();
    // More than one chunk of 256, or there is nothing for threads to share.
    assert!(most_pairs > 300, "{most_pairs} pairs");
    let text = S::text(&host.world);
    let mut machines = [0, 1].map(|player| Machine::<S>::new(player, bodies, machines[player]));
    for frame in 0..FRAMES + 8 {
        for machine in &mut machines {
            if frame < FRAMES {
                machine.play(frame);
            }
            // Messages take four to seven frames, and come in order.
            let arrived = (frame + 1).saturating_sub(4 + frame % 4).min(FRAMES);
            let arrived = if frame + 1 == FRAMES + 8 { FRAMES } else { arrived };
            while machine.known.len() < arrived {
                machine.receive(input_of(1 - machine.player, machine.known.len()));
                // Frames with confirmed inputs are final.
                let confirmed = machine.known.len().min(machine.said.len());
                assert!(machine.said[..confirmed] == truth[..confirmed], "after {frame} frames");
            }
        }
    }
    for machine in &machines {
        assert!(machine.corrected > FRAMES, "{} corrected", machine.corrected);
        assert!(machine.now.keys == host.keys && machine.said == truth);
        assert_equal_texts(&S::text(&machine.now.world), &text, machine.player as u128);
    }
    // There was something of each kind to be rolled back.
    for (what, name) in ["candidates", "contacts", "events", "impacts"].into_iter().enumerate() {
        let frames = truth.iter().filter(|said| said[what] != "[]").count();
        assert!(frames > FRAMES / 2, "{name} in {frames} frames");
    }
}

#[test]
fn clones_and_texts_roll_back_to_one_game_in_space() {
    check::<Volume>(20, [(true, 1), (false, 3)]);
}

#[test]
fn clones_and_texts_roll_back_to_one_game_in_the_plane() {
    check::<Plane>(20, [(false, 3), (true, 1)]);
}
