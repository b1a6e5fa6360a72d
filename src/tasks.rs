//! A run divided among many machines: each finds the results of some tasks, and one machine makes the report of all.

use asperity_contact_framework::Outcome;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::progress::Progress;

use crate::experiment::Experiment;

impl Experiment {
    /// Number of its tasks, and of the passes over all of them.
    pub fn tasks(&self) -> Result<[usize; 2], InputError> {
        self.divided().map(|divided| [divided.tasks(), divided.passes()])
    }

    /// What its task `task` (from 0) finds in the pass after those of `earlier`, which hold what all tasks have found: JSON.
    pub fn run_task(
        &self,
        task: usize,
        earlier: &[Vec<String>],
        progress: &dyn Progress,
    ) -> Result<String, InputError> {
        let divided = self.divided()?;
        self.check_passes(earlier)?;
        if task >= divided.tasks() || earlier.len() >= divided.passes() {
            let message = format!("found task {task} of {}; allowed: below", divided.tasks());
            return Err(InputError::file(self.path(), message));
        }
        divided.run_task(&self.context("", progress), task, earlier)
    }

    /// The results of a run, from what all tasks have found in all passes: the same to the bit as those of [`Self::run`]. `key` is
    /// [`Self::key`] from before the tasks ran.
    pub fn results_of_tasks(
        &self,
        passes: &[Vec<String>],
        key: &str,
        progress: &dyn Progress,
    ) -> Result<Box<dyn Outcome>, InputError> {
        let divided = self.divided()?;
        self.check_passes(passes)?;
        let input = self.watched_input(progress)?;
        if self.key_of(&input) != key {
            return Err(InputError::file(self.path(), "has an input file that changed; run again"));
        }
        divided.results(&self.context(&input, progress), passes)
    }

    fn check_passes(&self, passes: &[Vec<String>]) -> Result<(), InputError> {
        let tasks = self.divided()?.tasks();
        match passes.iter().find(|pass| pass.len() != tasks) {
            Some(pass) => {
                let message = format!("found the results of {} tasks; allowed: of all {tasks}", pass.len());
                Err(InputError::file(self.path(), message))
            }
            None => Ok(()),
        }
    }
}
