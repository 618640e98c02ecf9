use super::*;

#[test]
fn an_island_sleeps_when_its_last_body_is_calm_and_wakes_as_a_whole() {
    let mut islands = Islands::default();
    (0..6).for_each(|body| islands.add(body != 5));
    let step = |islands: &mut Islands, restless: Option<usize>| {
        for body in islands.awake.clone() {
            islands.note(body, if restless == Some(body) { 1.0 } else { 0.0 }, 0.3);
        }
        // 1, 3 and 4 are one island.
        if islands.awake.contains(&1) {
            islands.join(4, 3);
            islands.join(3, 1);
        }
        islands.settle()
    };
    assert!(step(&mut islands, None).is_empty() && islands.asleep.is_empty(), "it takes half a second");
    assert_eq!(step(&mut islands, Some(4)), [0, 2]);
    assert_eq!((&*islands.awake, &*islands.asleep), (&[1, 3, 4][..], &[0, 2][..]));
    assert!(step(&mut islands, None).is_empty());
    assert_eq!(step(&mut islands, None), [1, 3, 4]);
    assert_eq!((&*islands.awake, &*islands.asleep), (&[][..], &[0, 1, 2, 3, 4][..]));
    assert_eq!(islands.wake(&[4, 3]), [1, 3, 4]);
    assert_eq!((&*islands.awake, &*islands.asleep), (&[1, 3, 4][..], &[0, 2][..]));
    assert!(islands.wake(&[]).is_empty());
}
