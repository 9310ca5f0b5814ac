//! Plans: which stroke to play, by built-in rules or by those of the caller.
use crate::{
    check, count_of, sys, text, Call, Choice, Cue, Error, Facts, Options, PlanOptions, Player,
    Rules, RulesState, Ruling, ShotBall, Table, Turn,
};
use std::os::raw::{c_char, c_int};
use std::panic::{catch_unwind, AssertUnwindSafe};

/// Rules of a game. Sets of balls have bit k for ball k. The functions may be called from several
/// threads at once, and depend on their arguments only; `user` are the eight words of the state
/// that are theirs, as the player at the table has them. A function that panics ends the program.
pub trait Game {
    /// The balls that may be met first, and potted.
    fn on(user: &[u64; 8], in_play: u32) -> u32;
    /// The outcome of a shot; it leaves `user` as the next player has it.
    fn judge(user: &mut [u64; 8], in_play: u32, cue_ball: usize, facts: &Facts, call: Call)
        -> Turn;
    /// How many balls the player at the table and the other one have to pot to win.
    fn left(user: &[u64; 8], in_play: u32) -> [i32; 2];
}

/// The rules of a game, with a state that is all 0; `calls`, `race` and the like can be set.
pub fn rules<G: Game>() -> Rules {
    unsafe extern "C" fn on<G: Game>(game: *const RulesState, in_play: u32) -> u32 {
        guarded(|| G::on(unsafe { &(*game).user }, in_play))
    }
    unsafe extern "C" fn judge<G: Game>(
        game: *mut RulesState,
        in_play: u32,
        cue_ball: c_int,
        facts: *const Facts,
        call: Call,
    ) -> Turn {
        guarded(|| unsafe {
            G::judge(&mut (*game).user, in_play, cue_ball as usize, &*facts, call)
        })
    }
    unsafe extern "C" fn left<G: Game>(game: *const RulesState, in_play: u32, to: *mut i32) {
        guarded(|| unsafe { *to.cast() = G::left(&(*game).user, in_play) })
    }
    Rules {
        on: Some(on::<G>),
        judge: Some(judge::<G>),
        left: Some(left::<G>),
        ..Default::default()
    }
}

/// No panic passes through C.
fn guarded<T>(call: impl FnOnce() -> T) -> T {
    catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|_| std::process::abort())
}

/// Built-in rules, such as `sys::CAROM_RULES_NINEBALL`, with the state after the break.
pub fn built_in_rules(kind: sys::carom_rules_kind) -> Rules {
    unsafe { sys::carom_plan_rules_of(kind) }
}

/// A ruling in words.
pub fn words(of: &Ruling) -> String {
    let mut words = [0 as c_char; 256];
    unsafe { sys::carom_ruling_string(of, words.as_mut_ptr(), words.len()) };
    text(words.as_ptr())
}

/// The stroke that a player makes who means `cue`: with errors drawn from `seed` and the number of
/// the stroke.
pub fn strike(player: &Player, seed: u64, number: u64, cue: &Cue) -> Cue {
    let mut made = *cue;
    unsafe { sys::carom_player_strike(player, seed, number, &mut made) };
    made
}

/// A position for which plans are made.
#[derive(Clone)]
pub struct Position {
    pub table: Table,
    /// At rest.
    pub balls: Vec<ShotBall>,
    /// Its ball, masses and tip; the stroke itself is not read.
    pub cue: Cue,
    pub player: Player,
    /// None: the opponent errs as the player does.
    pub opponent: Option<Player>,
    pub rules: Rules,
    /// Models and space.
    pub shot: Options,
    /// `opponent` and `stop` of it are not read.
    pub options: PlanOptions,
}

impl Position {
    /// Of two players of the same rating, 0 to 1000, as by `sys::carom_player_fargo`.
    pub fn new(table: &Table, balls: &[ShotBall], cue: &Cue, rules: &Rules, rating: f64) -> Self {
        Position {
            table: *table,
            balls: balls.to_vec(),
            cue: *cue,
            player: unsafe { sys::carom_player_fargo(rating) },
            opponent: None,
            rules: *rules,
            shot: Options::default(),
            options: PlanOptions::default(),
        }
    }

    /// The best strokes, best first, at most `most`; in hand, with the places of the cue ball.
    pub fn plan(&self, most: usize, in_hand: bool) -> Result<Vec<Choice>, Error> {
        let mut all = self.clone().think(0, most, in_hand)?;
        all.go_on()?;
        Ok(all.choices)
    }

    /// A plan that is made in slices of so many events, about (500 take 1 ms), between the frames
    /// of a game.
    pub fn think(self, slice: i64, most: usize, in_hand: bool) -> Result<Thinking, Error> {
        let mut of = Box::new(self);
        of.options.slice = slice;
        let bytes = of.with_job(&mut [], |job| unsafe {
            sys::carom_plan_memory(job.options)
        });
        if bytes == 0 {
            check(sys::CAROM_ERROR_OPTIONS)?;
        }
        Ok(Thinking {
            of,
            memory: vec![0.0; bytes / 8 + 1],
            choices: Vec::new(),
            most: most.clamp(1, 1000),
            in_hand,
            begun: false,
            ended: false,
            wanted: Box::default(),
        })
    }

    /// The chances of strokes of the caller's, in their order.
    pub fn chances(&self, cues: &[Cue]) -> Result<Vec<Choice>, Error> {
        let mut told = vec![Choice::default(); cues.len()];
        let bytes = self.with_job(&mut [], |job| unsafe {
            sys::carom_plan_memory(job.options)
        });
        let mut memory = vec![0.0; bytes / 8 + 1];
        let count = cues.len().min(c_int::MAX as usize) as c_int;
        check(self.with_job(&mut memory, |job| unsafe {
            sys::carom_plan_try(job, cues.as_ptr(), count, told.as_mut_ptr())
        }))?;
        Ok(told)
    }

    /// The chance that the player at the table wins, without playing a shot.
    pub fn value(&self, in_hand: bool) -> Result<f64, Error> {
        let mut value = 0.0;
        check(self.with_job(&mut [], |job| unsafe {
            sys::carom_plan_value(job, in_hand.into(), &mut value)
        }))?;
        Ok(value)
    }

    fn with_job<T>(&self, memory: &mut [f64], call: impl FnOnce(&sys::carom_plan_job) -> T) -> T {
        let options = self.wanted();
        call(&self.job(&options, memory))
    }

    fn wanted(&self) -> PlanOptions {
        PlanOptions {
            opponent: self.opponent.as_ref().map_or(std::ptr::null(), |one| one),
            stop: std::ptr::null(),
            ..self.options
        }
    }

    fn job(&self, options: &PlanOptions, memory: &mut [f64]) -> sys::carom_plan_job {
        sys::carom_plan_job {
            table: &self.table,
            balls: self.balls.as_ptr(),
            count: i64::from(count_of(&self.balls)),
            cue: &self.cue,
            player: &self.player,
            rules: &self.rules,
            shot: &self.shot,
            options,
            memory: memory.as_mut_ptr().cast(),
            memory_size: memory.len() * 8,
            ..Default::default()
        }
    }
}

// The pointers in PlanOptions are not read; those in the memory are to boxes of the same object.
unsafe impl Send for Position {}
unsafe impl Sync for Position {}
unsafe impl Send for Thinking {}
unsafe impl Sync for Thinking {}

/// Where the game lets a cue ball in hand be put after a foul.
unsafe fn bounds_in_hand(job: &sys::carom_plan_job) -> sys::carom_bounds {
    let mut bounds = sys::carom_bounds::default();
    let about = sys::carom_rules_about_of((*job.rules).learned - 1);
    let leave = if about.is_null() {
        sys::CAROM_LEAVE_HAND
    } else {
        (*about).hand
    };
    sys::carom_hand_bounds(leave, job.table, 0.0, &mut bounds);
    bounds
}

/// A plan on its way.
pub struct Thinking {
    // Boxed, as the memory points to it and to the options.
    of: Box<Position>,
    wanted: Box<PlanOptions>,
    memory: Vec<f64>,
    choices: Vec<Choice>,
    most: usize,
    in_hand: bool,
    begun: bool,
    ended: bool,
}

impl Thinking {
    /// Plays a slice. Returns whether the plan has ended.
    pub fn go_on(&mut self) -> Result<bool, Error> {
        if self.ended {
            return Ok(true);
        }
        if !self.begun {
            *self.wanted = self.of.wanted();
        }
        let job = self.of.job(&self.wanted, &mut self.memory);
        let mut found = 0;
        let mut choices = vec![Choice::default(); self.most];
        let (to, room) = (choices.as_mut_ptr(), self.most as c_int);
        let status = unsafe {
            if self.begun {
                sys::carom_plan_continue(&job, to, room, &mut found)
            } else if self.in_hand {
                let bounds = bounds_in_hand(&job);
                let (low, high) = (bounds.low.as_ptr(), bounds.high.as_ptr());
                sys::carom_plan_hand(&job, low, high, to, room, &mut found)
            } else {
                sys::carom_plan(&job, to, room, &mut found)
            }
        };
        self.begun = true;
        self.ended = status < 0 || found > 0;
        check(status)?;
        choices.truncate(found as usize);
        self.choices = choices;
        Ok(self.ended)
    }

    /// The best strokes, best first; empty until the end.
    pub fn choices(&self) -> &[Choice] {
        &self.choices
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{aim, cue, place, rack, shoot, table, Pot};

    /// A drill: any ball counts, until one misses.
    struct Drill;

    impl Game for Drill {
        fn on(_: &[u64; 8], in_play: u32) -> u32 {
            in_play & !1
        }
        fn judge(user: &mut [u64; 8], _: u32, _: usize, facts: &Facts, _: Call) -> Turn {
            let potted = facts.down != 0 && facts.down & 1 == 0;
            user[0] += u64::from(potted);
            Turn {
                is: if potted {
                    sys::CAROM_TURN_KEEP
                } else {
                    sys::CAROM_TURN_PASS
                },
                points: f64::from(facts.down.count_ones()),
                ..Default::default()
            }
        }
        fn left(_: &[u64; 8], in_play: u32) -> [i32; 2] {
            [(in_play & !1).count_ones() as i32; 2]
        }
    }

    /// Two balls near a corner.
    fn layout() -> (Table, Vec<ShotBall>, Cue) {
        let table = table(sys::CAROM_TABLE_POOL_9FT).unwrap();
        let mut balls = rack(sys::CAROM_RACK_NINEBALL, &table, 1e-4, 1).unwrap();
        balls.truncate(3);
        for (k, (x, y)) in [(0.6, 0.9), (0.3, 0.4), (0.9, 2.0)].into_iter().enumerate() {
            assert!(place(&table, &mut balls, k, x, y).unwrap().is_ok());
        }
        (table, balls, cue(sys::CAROM_GAME_POOL))
    }

    #[test]
    fn slices_choose_what_one_call_chooses() {
        let (table, balls, cue) = layout();
        for rules in [built_in_rules(sys::CAROM_RULES_POTTING), rules::<Drill>()] {
            let mut of = Position::new(&table, &balls, &cue, &rules, 600.0);
            of.rules.race = sys::CAROM_RACE_ALONE;
            of.options.shots = 300;
            let best = of.plan(2, false).unwrap();
            assert!(best[0].value > 0.3 && best[0].keep > 0.5, "{best:?}");
            let mut mind = of.clone().think(20, 2, false).unwrap();
            let mut slices = 1;
            while !mind.go_on().unwrap() {
                slices += 1;
            }
            assert!(slices > 5 && mind.go_on().unwrap());
            for (one, other) in best.iter().zip(mind.choices()) {
                assert_eq!((one.cue.phi, one.value), (other.cue.phi, other.value));
            }
            let told = of.chances(&[best[0].cue, cue]).unwrap();
            assert!(told[0].keep > told[1].keep);
            assert!((0.0..=1.0).contains(&of.value(true).unwrap()));
            assert!(!of.plan(1, true).unwrap().is_empty());
            of.options.shots = -1;
            assert_eq!(
                of.plan(1, false).unwrap_err().status,
                sys::CAROM_ERROR_OPTIONS
            );
        }
    }

    #[test]
    fn an_aimed_pot_falls_and_a_stopped_shot_goes_on() {
        let (table, balls, mut cue) = layout();
        let options = Options::default();
        let mut pot = Pot {
            ball: 1,
            pocket: 0,
            ..Default::default()
        };
        cue.speed = 2.0;
        aim(&table, &balls, &mut pot, &mut cue, &options).unwrap();
        assert_eq!(pot.is, sys::CAROM_POT_FALLS);
        let whole = shoot(&table, &balls, &cue, &options).unwrap();
        assert_eq!(whole.facts().down & 2, 2);
        let mut parts = shoot(
            &table,
            &balls,
            &cue,
            &Options {
                time_most: 0.1,
                ..options
            },
        )
        .unwrap();
        while parts.status() == sys::CAROM_STOPPED_AT_TIME {
            let time_most = parts.time() + 0.2;
            parts
                .resume(
                    &table,
                    &Options {
                        time_most,
                        ..options
                    },
                )
                .unwrap();
        }
        assert_eq!(parts.events().len(), whole.events().len());
        for (one, other) in parts.last().iter().zip(whole.last()) {
            assert_eq!((one.r, one.w), (other.r, other.w));
        }
        assert_eq!(parts.resume(&table, &options).unwrap(), sys::CAROM_OK);
        assert!(whole.clone().resume(&table, &options).is_err());
        let player = unsafe { sys::carom_player_fargo(400.0) };
        assert_ne!(strike(&player, 1, 0, &cue).phi, cue.phi);
        pot.ball = 99;
        assert!(aim(&table, &balls, &mut pot, &mut cue, &options).is_err());
    }
}
