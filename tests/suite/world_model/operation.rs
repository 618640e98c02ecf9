//! Operations on a world.

use proptest::prelude::*;

/// An operation on a world. Bodies are numbered in order of insertion, including removed ones.
#[derive(Clone, Debug)]
pub(super) enum Operation {
    Insert {
        seed: u64,
    },
    InsertMany {
        seed: u64,
    },
    /// A mesh, a height field, a chain.
    Ground {
        seed: u64,
    },
    Move {
        body: usize,
        seed: u64,
    },
    /// Moves some bodies at once, with keys of removed ones among them.
    MoveMany {
        seed: u64,
    },
    /// Moves a body by a tiny amount, once or a few times.
    Nudge {
        body: usize,
        seed: u64,
    },
    /// Moves a body onto the grid, where bodies touch exactly.
    Settle {
        body: usize,
        seed: u64,
    },
    /// Sets a body's pose to its present pose.
    Stay {
        body: usize,
    },
    /// Sets a body's motion.
    Motion {
        body: usize,
        seed: u64,
    },
    Remove {
        body: usize,
    },
    /// Changes a property of a body.
    Change {
        body: usize,
        seed: u64,
    },
    Clear,
    /// Continues with a clone.
    Clone,
    /// Continues with a world restored from text.
    Restore,
    Update,
    /// Updates with both hooks.
    UpdateWith {
        seed: u64,
    },
    /// Updates with a limit on the number of pairs.
    UpdateWithin {
        most: usize,
    },
}

type Weighted = (u32, BoxedStrategy<Operation>);

fn of_seed(weight: u32, make: fn(u64) -> Operation) -> Weighted {
    (weight, any::<u64>().prop_map(make).boxed())
}

fn of_body(weight: u32, make: fn(usize, u64) -> Operation) -> Weighted {
    (weight, (0..1_usize << 20, any::<u64>()).prop_map(move |(body, seed)| make(body, seed)).boxed())
}

/// Bodies that come, jump, change and go: every bit of their contacts is known.
fn of_jumps() -> Vec<Weighted> {
    vec![
        of_seed(40, |seed| Operation::Insert { seed }),
        of_body(40, |body, seed| Operation::Move { body, seed }),
        of_body(10, |body, _| Operation::Stay { body }),
        of_body(20, |body, _| Operation::Remove { body }),
        (1, Just(Operation::Clear).boxed()),
        of_body(30, |body, seed| Operation::Change { body, seed }),
        (30, Just(Operation::Update).boxed()),
        of_seed(10, |seed| Operation::UpdateWith { seed }),
        (8, (0..120_usize).prop_map(|most| Operation::UpdateWithin { most }).boxed()),
    ]
}

pub(super) fn jump() -> impl Strategy<Value = Operation> {
    proptest::strategy::Union::new_weighted(of_jumps())
}

/// All operations.
pub(super) fn anything() -> impl Strategy<Value = Operation> {
    let mut all = of_jumps();
    all.extend([
        of_seed(3, |seed| Operation::InsertMany { seed }),
        of_seed(6, |seed| Operation::Ground { seed }),
        of_seed(5, |seed| Operation::MoveMany { seed }),
        of_body(60, |body, seed| Operation::Nudge { body, seed }),
        of_body(20, |body, seed| Operation::Settle { body, seed }),
        of_body(15, |body, seed| Operation::Motion { body, seed }),
        (1, Just(Operation::Clone).boxed()),
        (1, Just(Operation::Restore).boxed()),
        (20, Just(Operation::Update).boxed()),
    ]);
    proptest::strategy::Union::new_weighted(all)
}
