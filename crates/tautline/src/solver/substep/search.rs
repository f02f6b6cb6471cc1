//! Who may meet whom: the list of pairs, made from the boxes of all bodies, or of those that have left theirs.

use glam::{Mat3, Vec3};

use super::RigidSolver;
use super::boxes::Boxed;
use super::crew::Crew;
use super::lineup::Lineup;
use super::pairs::{Key, Pairs};
use crate::body::{Body, HalfSpace, Substance};
use crate::collision::Aabb;
use crate::collision::bvh::PairSearch;
use crate::parallel;
use crate::settings::Settings;
use crate::shape::{Part, Surface};
use crate::simd::Instructions;

/// From so many bodies on it pays to enclose them side by side.
const WORTHWHILE: usize = 1024;
/// So many that have left theirs are looked at at a time.
const CHUNK: usize = 32;
/// If more than one in so many leaves its box, all are made anew.
const FEW: usize = 8;

/// What the search keeps from step to step.
#[derive(Debug, Clone, Default)]
pub(super) struct BoxSearch {
    overlaps: PairSearch,
    /// The place of each box, ascending.
    places: Vec<u32>,
    /// All half-spaces.
    walls: Vec<u32>,
    keys: Vec<Key>,
    everyone: Everyone,
    /// The last list of pairs.
    spare: Pairs,
}

/// What a search for the pairs of all bodies needs while it lasts, by box.
#[derive(Debug, Clone, Default)]
struct Everyone {
    boxed: Vec<(Boxed, Aabb)>,
    bounds: Vec<Aabb>,
    bodies: Vec<u32>,
    movable: Vec<bool>,
    found: Vec<(u32, u32)>,
    /// By body.
    kinds: Vec<Kind>,
}

/// What of a box has to be looked up by its body.
#[derive(Debug, Clone, Copy, Default)]
struct Kind {
    /// The number of the box.
    number: u32,
    is_dynamic: bool,
    is_single: bool,
}

impl RigidSolver {
    /// Brings the list of pairs up to date if so many bodies may leave their boxes in this step; `is_first`: if there
    /// are no boxes yet.
    pub(super) fn find_pairs(
        &mut self,
        bodies: &[Body],
        settings: &Settings,
        leavers: usize,
        is_first: bool,
    ) {
        if is_first || leavers * FEW > self.lineup.places.len() {
            self.find_all_pairs(bodies, settings);
            return;
        }
        if leavers > 0 {
            self.find_pairs_of_leavers(bodies, settings);
        }
        self.end_search();
    }

    fn find_all_pairs(&mut self, bodies: &[Body], settings: &Settings) {
        let Self { search, lineup, crew, pairs, separated, .. } = self;
        crew.set_boxes(lineup);
        search.enclose(lineup, crew, bodies);
        search.keys.clear();
        search.pair_up(crew, bodies, separated, settings.instructions);
        for (boxed, bounds) in &search.everyone.boxed {
            pair_with_half_spaces(crew, bodies, (boxed, bounds), &search.walls, &mut search.keys);
        }
        search.keys.sort();
        pairs.replace(&search.keys, &mut search.spare);
    }

    /// The same list as if all pairs were looked for, from the boxes that there are and new ones of the leavers.
    fn find_pairs_of_leavers(&mut self, bodies: &[Body], settings: &Settings) {
        let Self { search, lineup, crew, pairs, separated, .. } = self;
        let leavers = crew.take_leavers(lineup);
        leavers.iter().for_each(|&(_, place)| crew.set_box(place));
        if !search.overlaps.is_fresh(search.places.len()) || search.places.is_empty() {
            search.enclose(lineup, crew, bodies);
            search.overlaps.build(&search.everyone.bounds);
        }
        let enclose = |&leaver: &(u32, u32)| {
            let boxed = Boxed::new(leaver, crew, bodies)?;
            let bounds = boxed.bounds(crew, bodies[leaver.0 as usize].rigid()?);
            Some((boxed, bounds))
        };
        let leavers: Vec<(Boxed, Aabb)> = leavers.iter().filter_map(enclose).collect();
        for (boxed, bounds) in &leavers {
            search.replace(boxed, *bounds);
        }
        let mut is_leaver = vec![false; bodies.len()];
        leavers.iter().for_each(|(boxed, _)| is_leaver[boxed.body as usize] = true);
        let scene = (&*lineup, &*crew, bodies, &separated[..]);
        let mut tasks: Vec<_> = leavers.chunks(CHUNK).map(|leavers| (leavers, Vec::new())).collect();
        parallel::for_each(&mut tasks, true, |(leavers, keys)| {
            for (boxed, bounds) in *leavers {
                search.pair_one(scene, (boxed, bounds), keys, settings.instructions);
                pair_with_half_spaces(scene.1, bodies, (boxed, bounds), &search.walls, keys);
            }
        });
        search.keys = tasks.into_iter().flat_map(|(_, keys)| keys).collect();
        // Two leavers have found each other.
        search.keys.sort();
        search.keys.dedup();
        pairs.replace_some(&is_leaver, &search.keys);
    }

    /// Gives back the memory of the search in a step that needs it not: most do not, once bodies rest.
    fn end_search(&mut self) {
        if self.search.everyone.boxed.capacity() > 0 {
            (self.search.everyone, self.search.spare) = (Everyone::default(), Pairs::default());
            self.search.keys = Vec::new();
            self.search.overlaps.shrink();
            self.pairs.shrink();
        }
    }
}

impl BoxSearch {
    /// Finds everybody's box. What is near stands near, so this goes by place.
    fn enclose(&mut self, lineup: &Lineup, crew: &Crew, bodies: &[Body]) {
        let Self { places, walls, everyone, .. } = self;
        let is_wall = |body: &Body| matches!(body.substance, Substance::HalfSpace(_));
        walls.clear();
        walls.extend((0..).zip(bodies).filter(|(_, body)| is_wall(body)).map(|(index, _)| index));
        let mut standing: Vec<(u32, u32)> = lineup.standing().collect();
        let worthwhile = parallel::is_worthwhile(standing.len(), WORTHWHILE);
        everyone.boxed.clear();
        parallel::filter_map(&mut standing, worthwhile, &mut (), &mut everyone.boxed, |(), &mut stand| {
            let boxed = Boxed::new(stand, crew, bodies)?;
            Some((boxed, boxed.bounds(crew, bodies[stand.0 as usize].rigid()?)))
        });
        let Everyone { boxed, bounds, bodies: indices, movable, kinds, .. } = everyone;
        places.clear();
        bounds.clear();
        movable.clear();
        indices.clear();
        kinds.clear();
        kinds.resize(bodies.len(), Kind::default());
        for (number, (boxed, bounded)) in (0..).zip(boxed) {
            places.push(boxed.place);
            bounds.push(*bounded);
            movable.push(boxed.is_dynamic);
            indices.push(boxed.body);
            let Boxed { is_dynamic, is_single, .. } = *boxed;
            kinds[boxed.body as usize] = Kind { number, is_dynamic, is_single };
        }
    }

    /// All pairs of boxes.
    fn pair_up(&mut self, crew: &Crew, bodies: &[Body], separated: &[[u32; 2]], instructions: Instructions) {
        let Self { overlaps, everyone, keys, .. } = self;
        let Everyone { boxed, bounds, bodies: indices, movable, found, kinds } = everyone;
        let may_meet = |a: u32, b: u32| boxed[a as usize].0.may_meet(&boxed[b as usize].0, separated);
        overlaps.find(bounds, movable, may_meet, instructions);
        overlaps.name(indices);
        overlaps.sort(bodies.len(), found);
        for &(a, b) in found.iter() {
            let [kind_a, kind_b] = [a, b].map(|body| kinds[body as usize]);
            if kind_a.is_single && kind_b.is_single {
                // Of the two the one that moves comes first.
                let (a, b) = if kind_a.is_dynamic { (a, b) } else { (b, a) };
                keys.push(Key { a, b, part_a: 0, part_b: 0 });
            } else {
                let [a, b] = [kind_a, kind_b].map(|kind| &boxed[kind.number as usize].0);
                pair_parts(crew, bodies, (a, b), keys);
            }
        }
    }

    /// Gives a box that is in the tree other bounds.
    fn replace(&mut self, boxed: &Boxed, bounds: Aabb) {
        if let Ok(number) = self.places.binary_search(&boxed.place) {
            self.overlaps.replace(number as u32, bounds);
        }
    }

    /// All pairs of one box.
    fn pair_one(
        &self,
        (lineup, crew, bodies, separated): (&Lineup, &Crew, &[Body], &[[u32; 2]]),
        (boxed, bounds): (&Boxed, &Aabb),
        keys: &mut Vec<Key>,
        instructions: Instructions,
    ) {
        let Self { overlaps, places, .. } = self;
        overlaps.overlaps(*bounds, instructions, |number| {
            let place = places[number as usize];
            let body = lineup.places[place as usize];
            let Some(other) = Boxed::new((body, place), crew, bodies) else { return };
            let may_move = boxed.is_dynamic || other.is_dynamic;
            if body != boxed.body && may_move && boxed.may_meet(&other, separated) {
                pair_parts(crew, bodies, (boxed, &other), keys);
            }
        });
    }
}

/// Every part that reaches over a plane.
fn pair_with_half_spaces(
    crew: &Crew,
    bodies: &[Body],
    (boxed, bounds): (&Boxed, &Aabb),
    walls: &[u32],
    keys: &mut Vec<Key>,
) {
    if !boxed.meets_half_spaces() {
        return;
    }
    for &wall_body in walls {
        let Substance::HalfSpace(wall) = &bodies[wall_body as usize].substance else { continue };
        if !reaches_over(bounds, wall) {
            continue;
        }
        let Some(rigid) = bodies[boxed.body as usize].rigid() else { continue };
        let axes = boxed.axes(crew);
        for (part_a, part) in (0..).zip(rigid.shape.parts()) {
            if reaches_over(&boxed.box_of(&axes, part), wall) {
                keys.push(Key { a: boxed.body, b: wall_body, part_a, part_b: 0 });
            }
        }
    }
}

/// All pairs of parts, or of parts and triangles, whose boxes overlap.
fn pair_parts(crew: &Crew, bodies: &[Body], (a, b): (&Boxed, &Boxed), keys: &mut Vec<Key>) {
    let (a, b) = if a.body < b.body { (a, b) } else { (b, a) };
    // Of the two the one that moves comes first.
    let (a, b) = if a.is_dynamic { (a, b) } else { (b, a) };
    if a.is_single && b.is_single {
        keys.push(Key { a: a.body, b: b.body, part_a: 0, part_b: 0 });
        return;
    }
    let [Some(rigid_a), Some(rigid_b)] = [a, b].map(|boxed| bodies[boxed.body as usize].rigid()) else {
        return;
    };
    let (axes_a, axes_b) = (a.axes(crew), b.axes(crew));
    if let Some(surface) = rigid_b.shape.surface() {
        pair_with_triangles((a, &axes_a, rigid_a.shape.parts()), (b, &axes_b, surface), keys);
        return;
    }
    for (part_a, box_a) in (0..).zip(rigid_a.shape.parts()) {
        let box_a = a.box_of(&axes_a, box_a);
        for (part_b, box_b) in (0..).zip(rigid_b.shape.parts()) {
            if box_a.overlaps(&b.box_of(&axes_b, box_b)) {
                keys.push(Key { a: a.body, b: b.body, part_a, part_b });
            }
        }
    }
}

/// All triangles of a surface near the parts of a body.
fn pair_with_triangles(
    (a, axes_a, parts): (&Boxed, &Mat3, &[Part]),
    (b, axes_b, surface): (&Boxed, &Mat3, &Surface),
    keys: &mut Vec<Key>,
) {
    let mut triangles = Vec::new();
    let to_b = axes_b.transpose();
    let (center, axes) = (to_b * (a.center - b.center), to_b * *axes_a);
    for (part_a, part) in (0..).zip(parts) {
        let near = Aabb::around_turned(center, &axes, part.low, part.high).grown(a.room + b.room);
        triangles.clear();
        surface.triangles_in(near.low, near.high, &mut triangles);
        keys.extend(triangles.iter().map(|&part_b| Key { a: a.body, b: b.body, part_a, part_b }));
    }
}

fn reaches_over(bounds: &Aabb, wall: &HalfSpace) -> bool {
    let lowest = Vec3::select(wall.normal.cmpgt(Vec3::ZERO), bounds.low, bounds.high);
    wall.normal.dot(lowest) <= wall.offset
}
