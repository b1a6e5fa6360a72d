//! Groups of asperities that are left out in turn.

use std::convert::Infallible;
use std::sync::Arc;

use rand::seq::SliceRandom;
use rand::{SeedableRng, TryRng};
use rand_chacha::ChaCha8Rng;

use crate::asperity::{AsperitySet, Places};
use crate::memory::zeros;
use crate::numeric::parallel;
use crate::progress::{Count, PIECE, Progress, Silent};
use crate::topography::{Blocks, MIN_BLOCKS};

/// Number of groups of independent draws; as many as blocks of a map, at least.
pub const GROUPS: usize = MIN_BLOCKS;

/// A division of a set of asperities and of its nominal area into groups.
#[derive(Debug, Clone, PartialEq)]
pub struct Division {
    /// The asperities group by group, and where each group begins, with their number.
    members: Arc<Vec<usize>>,
    ends: Vec<usize>,
    /// The share of each group in the nominal area.
    shares: Vec<f64>,
}

impl Division {
    /// Blocks of a map; `positions` are the points of its asperities, `shares` those of the blocks in its nominal area.
    pub fn of_blocks(blocks: &Blocks, positions: &[usize], shares: Vec<f64>) -> Self {
        debug_assert_eq!(shares.len(), blocks.count());
        let group = positions.iter().map(|&at| blocks.of_point(at) as u16).collect();
        Self::new(group, shares, &Silent)
    }

    /// Random groups of `count` independent asperities, of equal number within one; `None` for fewer than two in each. To `progress` it
    /// shows that it goes on.
    pub fn independent(count: usize, seed: [u8; 32], progress: &dyn Progress) -> Option<Self> {
        Self::random(count, GROUPS, seed, progress)
    }

    /// Both halves of `count` independent asperities at random; `None` for fewer than two in each. To `progress` it shows that it goes on.
    pub fn random_halves(count: usize, seed: [u8; 32], progress: &dyn Progress) -> Option<Self> {
        Self::random(count, 2, seed, progress)
    }

    fn random(count: usize, groups: usize, seed: [u8; 32], progress: &dyn Progress) -> Option<Self> {
        if count < 2 * groups {
            return None;
        }
        let mut group: Vec<u16> = (0..count).map(|index| (index % groups) as u16).collect();
        group.shuffle(&mut Watched {
            numbers: ChaCha8Rng::from_seed(seed),
            drawn: Count::new(progress, 0.0, count),
        });
        let share = |k: usize| (count + groups - 1 - k) / groups;
        Some(Self::new(group, (0..groups).map(|k| share(k) as f64 / count as f64).collect(), progress))
    }

    /// From the group of each asperity.
    fn new(group: Vec<u16>, shares: Vec<f64>, progress: &dyn Progress) -> Self {
        let mut ends = vec![0; shares.len() + 1];
        for groups in group.chunks(PIECE) {
            groups.iter().for_each(|&group| ends[usize::from(group) + 1] += 1);
            progress.advance(0.0);
        }
        for k in 1..ends.len() {
            ends[k] += ends[k - 1];
        }
        let (mut next, mut members) = (ends.clone(), zeros(group.len()));
        for (piece, groups) in group.chunks(PIECE).enumerate() {
            for (index, &group) in groups.iter().enumerate() {
                let next = &mut next[usize::from(group)];
                members[*next] = piece * PIECE + index;
                *next += 1;
            }
            progress.advance(0.0);
        }
        Self { members: members.into(), ends, shares }
    }

    /// The asperities of a group.
    fn members(&self, group: usize) -> Places {
        Places { list: self.members.clone(), part: self.ends[group]..self.ends[group + 1] }
    }

    /// Number of asperities in a group.
    pub fn count_of(&self, group: usize) -> usize {
        self.ends[group + 1] - self.ends[group]
    }

    /// The share of each group in the nominal area.
    pub fn shares(&self) -> &[f64] {
        &self.shares
    }

    /// The result of `task` for each group, in their order; tasks run in parallel.
    pub fn for_each_group<T: Send + Sync>(&self, task: impl Fn(usize) -> T + Sync) -> Vec<T> {
        parallel::map(self.shares.len(), task)
    }

    /// `set` without a group and its area; `None` where nothing is left.
    pub fn without(&self, set: &AsperitySet, group: usize) -> Option<AsperitySet> {
        set.excluding(self.members(group), set.nominal_area() * (1.0 - self.shares[group]))
    }

    /// A group of `set` on its area; `None` where it holds no asperity.
    pub fn only(&self, set: &AsperitySet, group: usize) -> Option<AsperitySet> {
        set.selected(self.members(group).as_slice(), set.nominal_area() * self.shares[group])
    }
}

/// Random numbers that are counted as they are drawn.
struct Watched<'a> {
    numbers: ChaCha8Rng,
    drawn: Count<'a>,
}

impl TryRng for Watched<'_> {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        self.drawn.add(1);
        self.numbers.try_next_u32()
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        self.drawn.add(1);
        self.numbers.try_next_u64()
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        self.drawn.add(bytes.len() / size_of::<u32>());
        self.numbers.try_fill_bytes(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(count: usize) -> AsperitySet {
        let heights = (0..count).map(|k| k as f64).collect();
        AsperitySet::new(heights, vec![1.0; count], 2.0).unwrap()
    }

    #[test]
    fn each_asperity_is_left_out_once() {
        let (count, set) = (100, set(100));
        let division = Division::independent(count, [1; 32], &Silent).unwrap();
        assert!((division.shares().iter().sum::<f64>() - 1.0).abs() < 1e-15);
        let mut kept = vec![0; count];
        for (group, share) in division.shares().iter().enumerate() {
            let rest = division.without(&set, group).unwrap();
            assert_eq!(rest.count(), count - (share * 100.0).round() as usize);
            rest.heights().iter().for_each(|&z| kept[z as usize] += 1);
            assert_eq!((rest.heights().len(), rest.radii().len()), (rest.count(), rest.count()));
            assert!((rest.nominal_area() - 2.0 * (1.0 - share)).abs() < 1e-15);
            let part = division.only(&set, group).unwrap();
            assert_eq!(part.count() + rest.count(), count);
            assert!((part.nominal_area() + rest.nominal_area() - 2.0).abs() < 1e-15);
        }
        assert_eq!(kept, [GROUPS - 1; 100]);
        assert_ne!(division, Division::independent(count, [2; 32], &Silent).unwrap());
        assert_eq!(Division::independent(31, [1; 32], &Silent), None);
    }

    #[test]
    fn random_halves_are_equal_and_disjoint() {
        let division = Division::random_halves(101, [1; 32], &Silent).unwrap();
        let parts = [0, 1].map(|half| division.only(&set(101), half).unwrap());
        assert_eq!(parts.each_ref().map(AsperitySet::count), [51, 50]);
        assert_eq!(parts[0].heights(), division.without(&set(101), 1).unwrap().heights());
        assert!(parts[0].heights().iter().all(|z| !parts[1].heights().contains(z)));
        assert_eq!(Division::random_halves(3, [1; 32], &Silent), None);
    }

    #[test]
    fn blocks_hold_the_asperities_on_their_points() {
        let blocks = Blocks { points: [4, 6], counts: [2, 3] };
        let positions = [0, 7, 5, 23, 15];
        let division = Division::of_blocks(&blocks, &positions, vec![1.0 / 6.0; 6]);
        let members: Vec<Vec<usize>> =
            (0..6).map(|group| division.members(group).as_slice().to_vec()).collect();
        assert_eq!(members, [&[0, 1][..], &[], &[2], &[], &[4], &[3]]);
        let rest = division.without(&set(5), 0).unwrap();
        assert_eq!(rest.heights(), [2.0, 3.0, 4.0]);
        let all = Division::new(vec![0; 5], vec![1.0], &Silent);
        assert_eq!(all.without(&set(5), 0), None);
    }
}
