//! Rollback networking: two machines play one game, inputs arrive late, and both end in the same bits.
//!
//! Each machine guesses that the other's player goes on as before. The true input arrives five to eight frames late. If
//! it differs from the guess, the machine restores its copy of the world from before that frame and plays on from there
//! with the true input.

use asunder::glam::{DVec2, Vec2};
use asunder::{BodyKey2, Circle, Collider2, Pose2, Rect, World2};

const FRAMES: usize = 60;

/// The state of the game: all that the next frame depends on.
#[derive(Clone)]
struct Game {
    world: World2,
    players: [BodyKey2; 2],
    /// How often the players bumped into anything.
    bumps: u64,
}

/// How far a player wants to move, in metres a frame.
type Input = DVec2;

impl Game {
    fn new() -> Result<Self, Box<dyn std::error::Error>> {
        let mut world = World2::new();
        let crate_ = Rect::from_half_extents(Vec2::splat(0.5))?;
        for i in 0..20 {
            let at = DVec2::new(f64::from(i % 5) * 1.5 - 3.0, f64::from(i / 5) * 1.5 - 2.0);
            world.insert(Collider2::new(crate_).at(Pose2::at(at)?));
        }
        let ball = Collider2::new(Circle::new(0.4)?);
        let left = world.insert(ball.clone().at(Pose2::at([-4.0, 0.0])?));
        let right = world.insert(ball.at(Pose2::at([4.0, 0.0])?));
        Ok(Self { world, players: [left, right], bumps: 0 })
    }

    /// Moves the players, updates the world, and pushes overlapping bodies apart.
    fn step(&mut self, inputs: [Input; 2]) -> Result<(), Box<dyn std::error::Error>> {
        for (key, input) in self.players.into_iter().zip(inputs) {
            shift(&mut self.world, key, input)?;
        }
        self.world.update();
        self.bumps += self.world.events().iter().filter(|event| event.is_began()).count() as u64;
        let pushes: Vec<(BodyKey2, DVec2)> = self
            .world
            .contacts()
            .flat_map(|contact| {
                contact.manifolds.iter().flat_map(move |manifold| {
                    let out = (manifold.normal * manifold.separation.min(0.0) * 0.5).as_dvec2();
                    [(contact.a, out), (contact.b, -out)]
                })
            })
            .collect();
        for (key, push) in pushes {
            shift(&mut self.world, key, push)?;
        }
        Ok(())
    }
}

fn shift(world: &mut World2, key: BodyKey2, by: DVec2) -> Result<(), Box<dyn std::error::Error>> {
    let Some(pose) = world.get(key).map(|body| *body.pose()) else { return Ok(()) };
    Ok(world.set_pose(key, Pose2::new(pose.position() + by, pose.rotation())?)?)
}

/// One of the two computers.
struct Machine {
    player: usize,
    /// The game before each frame: `past[f]` is the state that frame f was played from. A clone each frame is cheap,
    /// and has the same future as the original.
    past: Vec<Game>,
    now: Game,
    /// The other player's inputs that have arrived so far, by frame.
    known: Vec<Input>,
    rollbacks: usize,
}

impl Machine {
    fn new(player: usize) -> Result<Self, Box<dyn std::error::Error>> {
        Ok(Self { player, past: Vec::new(), now: Game::new()?, known: Vec::new(), rollbacks: 0 })
    }

    /// The other player's input: the true one if it has arrived, else the last known one as a guess.
    fn other(&self, frame: usize) -> Input {
        self.known.get(frame).or(self.known.last()).copied().unwrap_or(Input::ZERO)
    }

    fn play(&mut self, frame: usize) -> Result<(), Box<dyn std::error::Error>> {
        let mut inputs = [input_of(self.player, frame); 2];
        inputs[1 - self.player] = self.other(frame);
        self.past.truncate(frame);
        self.past.push(self.now.clone());
        self.now.step(inputs)
    }

    /// The other player's input for the next unknown frame arrives. If the guess was wrong, goes back to that frame and
    /// replays up to now.
    fn receive(&mut self, input: Input) -> Result<(), Box<dyn std::error::Error>> {
        let (frame, now) = (self.known.len(), self.past.len());
        let guess = self.other(frame);
        self.known.push(input);
        if frame < now && guess != input {
            self.rollbacks += 1;
            self.now = self.past[frame].clone();
            for again in frame..now {
                self.play(again)?;
            }
        }
        Ok(())
    }
}

/// The input of a player, who changes direction every few frames.
fn input_of(player: usize, frame: usize) -> Input {
    let ways = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::new(0.6, 0.8), DVec2::NEG_Y];
    let way = ways[(frame / 7 + 2 * player) % ways.len()] * 0.2;
    if player == 0 { way } else { -way }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut machines = [Machine::new(0)?, Machine::new(1)?];
    for frame in 0..FRAMES + 8 {
        for machine in &mut machines {
            if frame < FRAMES {
                machine.play(frame)?;
            }
            // Messages take five to eight frames, and come in order.
            let arrived = (frame + 1).saturating_sub(5 + frame % 4).min(FRAMES);
            let everything = if frame + 1 == FRAMES + 8 { FRAMES } else { arrived };
            while machine.known.len() < everything {
                machine.receive(input_of(1 - machine.player, machine.known.len()))?;
            }
        }
    }
    let [one, other] = &machines;
    let checksums = [one, other].map(|machine| machine.now.world.snapshot().checksum());
    println!("{FRAMES} frames, {} and {} rollbacks", one.rollbacks, other.rollbacks);
    println!("checksums {:016x} and {:016x}", checksums[0], checksums[1]);
    assert_eq!(checksums[0], checksums[1], "both played the same game");
    assert_eq!(one.now.bumps, other.now.bumps);

    // A third machine joins: the whole world is sent to it as a snapshot, and plays on just as it does for the others.
    let wire = serde_json::to_string(&one.now.world.snapshot())?;
    let world = World2::restore(&serde_json::from_str(&wire)?)?;
    let mut joined = Game { world, ..one.now.clone() };
    let mut host = other.now.clone();
    for frame in 0..FRAMES {
        let inputs = [input_of(0, frame), input_of(1, frame)];
        joined.step(inputs)?;
        host.step(inputs)?;
    }
    let checksum = joined.world.snapshot().checksum();
    println!("joined by {} bytes of JSON; {FRAMES} frames later {checksum:016x}", wire.len());
    assert_eq!(checksum, host.world.snapshot().checksum(), "and so did the third");
    Ok(())
}
