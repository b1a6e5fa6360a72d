//! Windows with spikes planted in them.

use asperity::HeightMap;
use asperity::numeric::median;
use asperity::topography::fitness::{Check, Finding, Measure, Spikes};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::process::Unusable;
use super::studied::{StudiedWindow, StudyTask};

/// Spikes of one point planted in a window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlantedSpikes {
    /// Number of spikes.
    pub count: usize,
    /// Heights above the medians around them, in robust standard deviations of such deviations.
    pub deviations: f64,
}

impl PlantedSpikes {
    /// Half the side of the window of the median, in points.
    const REACH: usize = 4;

    /// `window` with the spikes in random places.
    ///
    /// # Errors
    /// Heights that form no map.
    pub fn plant(&self, window: &HeightMap, seed: [u8; 32]) -> Result<HeightMap, Unusable> {
        let height = self.deviations * Spikes::scale(window);
        let points = window.points();
        let mut rng = ChaCha8Rng::from_seed(seed);
        let mut heights = window.heights().to_vec();
        for _ in 0..self.count {
            let [x, y] = points.map(|count| rng.random_range(Self::REACH..count - Self::REACH));
            let rows = x - Self::REACH..=x + Self::REACH;
            let mut around: Vec<f64> = rows
                .flat_map(|row| &window.heights()[row * points[1] + y - Self::REACH..][..=2 * Self::REACH])
                .copied()
                .collect();
            heights[x * points[1] + y] = median(&mut around).unwrap_or_default() + height;
        }
        Ok(HeightMap::new(points, window.pixel(), heights, f64::EPSILON)?)
    }

    /// The window with the spikes, studied.
    ///
    /// # Errors
    /// See [`Unusable`].
    pub fn study(
        &self,
        task: &StudyTask,
        window: &HeightMap,
        seed: [u8; 32],
    ) -> Result<StudiedWindow, Unusable> {
        let spiked = self.plant(window, seed)?;
        let count = Spikes::find(&spiked).count();
        if count > 0 {
            // No verdict: the rest of the study changes nothing.
            let finding = Finding { check: Check::Spikes, measure: Measure::Spikes, value: count as f64 };
            return Ok(StudiedWindow { findings: vec![finding], verdicts: Vec::new() });
        }
        task.run(&spiked)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spikes_have_the_height_and_number_asked_for() {
        let wave = |k: usize| ((k % 64) as f64 * 0.3).sin() + ((k / 64) as f64 * 0.2).cos();
        let window = HeightMap::new([64; 2], [1.0; 2], (0..4096).map(wave).collect(), 0.0).unwrap();
        let planted = PlantedSpikes { count: 5, deviations: 20.0 };
        let spiked = planted.plant(&window, [1; 32]).unwrap();
        let height = 20.0 * Spikes::scale(&window);
        let changed = spiked.heights().iter().zip(window.heights()).filter(|(a, b)| a != b);
        let steps: Vec<f64> = changed.map(|(a, b)| a - b).collect();
        assert_eq!(steps.len(), 5);
        assert!(steps.iter().all(|step| (step / height - 1.0).abs() < 0.2), "{steps:?} {height}");
        assert_eq!(Spikes::find(&spiked).count(), 5);
        assert_eq!(planted.plant(&window, [1; 32]).unwrap(), spiked);
    }
}
