//! Plans: which stroke to play, by built-in or custom rules.
use crate::{
    calls, check, count_of, sys, text, BallState, Bounds, Call, Cue, Error, Facts, Leave, Options,
    PlanOptions, PlanStroke, Player, RackKind, Rules, RulesKind, RulesState, ShotBall, Status,
    Table, Turn,
};
use std::any::{type_name, TypeId};
use std::os::raw::{c_char, c_int};
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Rules of a game. Sets of balls have bit k for ball k. The functions may be called from several
/// threads at once, and must depend only on their arguments; `user` has eight integers of the state
/// for the rules, from the view of the player at the table. If a function panics, the call that
/// uses the rules returns an error at its end; if panics abort, the program ends. `carom_plan.h`
/// describes the functions; the library has defaults for functions that are None.
pub trait GameRules: 'static {
    /// The balls that may be met first, and potted.
    fn on(user: &[u64; 8], in_play: u32) -> u32;
    /// The outcome of a shot; it leaves `user` from the view of the next player.
    fn judge(user: &mut [u64; 8], in_play: u32, cue_ball: usize, facts: &Facts, call: Call)
        -> Turn;
    /// How many balls the player at the table and the opponent have to pot to win; in a race for
    /// points, how many points.
    fn left(user: &[u64; 8], in_play: u32) -> [i32; 2];
    /// The pockets in which balls count for the player at the table, as a set.
    const POCKETS: Option<fn(user: &[u64; 8]) -> u32> = None;
    /// The chance that the player at the table wins, 0 to 1; without an opponent, the expected
    /// number of balls that this player still pots.
    const VALUE: Option<fn(user: &[u64; 8], layout: &[BallState], in_hand: bool) -> f64> = None;
    /// In a race for points, the points of a ball that falls in the next stroke; without a ball,
    /// the mean of a later pot.
    const POINTS: Option<fn(user: &[u64; 8], in_play: u32, ball: Option<usize>) -> f64> = None;
    /// Applies the rules that depend on the positions of the balls after a stroke was judged, and
    /// spots the balls of `turn.spot`, as `spot` does.
    const SETTLE: Option<fn(user: &mut [u64; 8], &Table, balls: &mut [ShotBall], &mut Turn)> = None;
}

/// The rules of a game, with a state that is all 0; `calls`, `race` and other members can be set.
pub fn rules<G: GameRules>() -> Rules {
    unsafe extern "C" fn on<G: GameRules>(game: *const RulesState, in_play: u32) -> u32 {
        guarded::<G, _>(0, || G::on(unsafe { &(*game).user }, in_play))
    }
    unsafe extern "C" fn judge<G: GameRules>(
        game: *mut RulesState,
        in_play: u32,
        cue_ball: c_int,
        facts: *const Facts,
        call: Call,
    ) -> Turn {
        guarded::<G, _>(Turn::default(), || unsafe {
            G::judge(&mut (*game).user, in_play, cue_ball as usize, &*facts, call)
        })
    }
    unsafe extern "C" fn left<G: GameRules>(game: *const RulesState, in_play: u32, to: *mut i32) {
        *to.cast() = guarded::<G, _>([1, 1], || G::left(unsafe { &(*game).user }, in_play));
    }
    unsafe extern "C" fn pockets<G: GameRules>(game: *const RulesState) -> u32 {
        guarded::<G, _>(0, || {
            G::POCKETS.map_or(0, |call| call(unsafe { &(*game).user }))
        })
    }
    unsafe extern "C" fn value<G: GameRules>(
        game: *const RulesState,
        layout: *const BallState,
        count: c_int,
        in_hand: c_int,
    ) -> f64 {
        guarded::<G, _>(0.0, || unsafe {
            let layout = std::slice::from_raw_parts(layout, count as usize);
            G::VALUE.map_or(0.0, |call| call(&(*game).user, layout, in_hand != 0))
        })
    }
    unsafe extern "C" fn points<G: GameRules>(
        game: *const RulesState,
        in_play: u32,
        ball: c_int,
    ) -> f64 {
        guarded::<G, _>(0.0, || {
            let (user, ball) = (unsafe { &(*game).user }, usize::try_from(ball).ok());
            G::POINTS.map_or(0.0, |call| call(user, in_play, ball))
        })
    }
    unsafe extern "C" fn settle<G: GameRules>(
        game: *mut RulesState,
        table: *const Table,
        balls: *mut ShotBall,
        count: c_int,
        turn: *mut Turn,
    ) {
        guarded::<G, _>((), || unsafe {
            let balls = std::slice::from_raw_parts_mut(balls, count as usize);
            if let Some(call) = G::SETTLE {
                call(&mut (*game).user, &*table, balls, &mut *turn);
            }
        })
    }
    let made = Rules {
        on: Some(on::<G>),
        judge: Some(judge::<G>),
        left: Some(left::<G>),
        pockets: G::POCKETS.map(|_| pockets::<G> as _),
        value: G::VALUE.map(|_| value::<G> as _),
        points: G::POINTS.map(|_| points::<G> as _),
        settle: G::SETTLE.map(|_| settle::<G> as _),
        ..Default::default()
    };
    panics_of::<G, _>(|of| of.on.extend(made.on.map(|one| one as usize)));
    made
}

/// The panics of custom rules, and the functions by which plans identify the rules.
struct Panics {
    of: TypeId,
    on: Vec<usize>,
    count: u64,
    words: String,
}
static PANICS: Mutex<Vec<Panics>> = Mutex::new(Vec::new());

fn panics() -> MutexGuard<'static, Vec<Panics>> {
    PANICS.lock().unwrap_or_else(PoisonError::into_inner)
}

fn panics_of<G: GameRules, T>(call: impl FnOnce(&mut Panics) -> T) -> T {
    let (of, mut all) = (TypeId::of::<G>(), panics());
    let at = all.iter().position(|one| one.of == of).unwrap_or(all.len());
    if at == all.len() {
        all.push(Panics {
            of,
            on: Vec::new(),
            count: 0,
            words: String::new(),
        });
    }
    call(&mut all[at])
}

/// No panic passes through C: the call that uses the rules returns it as an error.
fn guarded<G: GameRules, T>(otherwise: T, call: impl FnOnce() -> T) -> T {
    catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|cause| {
        let text = cause.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| cause.downcast_ref::<&str>().copied());
        let (name, text) = (type_name::<G>(), text.unwrap_or("no text"));
        panics_of::<G, _>(|of| {
            of.count += 1;
            of.words = format!("the rules {name} panicked: {text}");
        });
        otherwise
    })
}

/// Whether custom rules have panicked since it was made.
pub(crate) struct Watch {
    on: usize,
    before: u64,
}

impl Watch {
    pub(crate) fn new(rules: &Rules) -> Watch {
        let on = rules.on.map_or(0, |one| one as usize);
        let before = Watch::seen(on).0;
        Watch { on, before }
    }

    /// The number of panics, and the message of one of them.
    fn seen(on: usize) -> (u64, String) {
        panics().iter().filter(|one| one.on.contains(&on)).fold(
            (0, String::new()),
            |(count, words), one| {
                let last = if one.count > 0 { &one.words } else { &words };
                (count + one.count, last.clone())
            },
        )
    }

    pub(crate) fn check(&self, status: sys::carom_status) -> Result<Status, Error> {
        let (count, fault) = Watch::seen(self.on);
        if count > self.before {
            let status = Status::ErrorOptions;
            return Err(Error { status, fault });
        }
        check(status)
    }

    /// The same for the status of a plan, whose error names the rejected member of its job.
    fn check_plan(
        &self,
        status: sys::carom_status,
        job: &sys::carom_plan_job,
    ) -> Result<Status, Error> {
        self.check(sys::CAROM_OK)?;
        check_plan(status, job)
    }
}

/// Checks the status of a plan. An error names the rejected member of its job.
fn check_plan(status: sys::carom_status, job: &sys::carom_plan_job) -> Result<Status, Error> {
    let mut fault = [0 as c_char; 200];
    if status == sys::CAROM_ERROR_OPTIONS {
        unsafe { sys::carom_plan_fault(job, fault.as_mut_ptr(), fault.len()) };
    }
    check(status).map_err(|error| Error {
        fault: text(fault.as_ptr()),
        ..error
    })
}

/// Spots a ball by the rules of a rack's game.
pub fn spot(
    kind: RackKind,
    table: &Table,
    balls: &mut [ShotBall],
    ball: usize,
) -> Result<(), Error> {
    let ball = ball.min(i32::MAX as usize) as i32;
    calls::spot_ball_of(kind, table, balls, ball).map(|_| ())
}

/// The stroke of a player who intends `cue`, with errors drawn from `seed` and the number of the
/// stroke.
pub fn strike(player: &Player, seed: u64, number: u64, cue: &Cue) -> Cue {
    let mut made = *cue;
    calls::player_strike(player, seed, number, &mut made);
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
    /// None: an opponent with the errors of the player.
    pub opponent: Option<Player>,
    pub rules: Rules,
    /// Models and space.
    pub shot: Options,
    /// `opponent` and `stop` of it are not read.
    pub options: PlanOptions,
    /// The bounds of a cue ball in hand, as in a match. None: the bounds of the game after a foul,
    /// if a plan is made in hand. After a scratch on the break of eight-ball, set the bounds of the
    /// ruling, because the rules do not know the previous stroke.
    pub bounds: Option<Bounds>,
    /// The bounds within which the cue ball was placed for this stroke: from behind the head string
    /// it may not first meet balls that are there too.
    pub leave: Leave,
}

impl Position {
    /// For two players of the same rating in this game, 200 to 850, as by `calls::player_rated`.
    pub fn new(table: &Table, balls: &[ShotBall], cue: &Cue, rules: &Rules, rating: f64) -> Self {
        let game = RulesKind::try_from(rules.learned - 1).unwrap_or(RulesKind::Eightball);
        Position {
            table: *table,
            balls: balls.to_vec(),
            cue: *cue,
            player: calls::player_rated(rating, game),
            opponent: None,
            rules: *rules,
            shot: Options::default(),
            options: PlanOptions::default(),
            bounds: None,
            leave: Leave::After,
        }
    }

    /// The best strokes, best first, at most `most`; in hand, with the positions of the cue ball.
    pub fn plan(&self, most: usize, in_hand: bool) -> Result<Vec<PlanStroke>, Error> {
        let mut all = self.clone().think(0, most, in_hand)?;
        all.go_on()?;
        Ok(all.choices)
    }

    /// A plan that is made in slices of about `slice` events (500 take 1 ms), between the frames of
    /// a game.
    pub fn think(self, slice: i64, most: usize, in_hand: bool) -> Result<Thinking, Error> {
        let mut of = Box::new(self);
        of.options.slice = slice;
        let is_placed = of.leave != Leave::After && of.leave != Leave::Before;
        if in_hand && of.bounds.is_none() && !is_placed {
            of.leave = leave_in_hand(&of);
        }
        let bytes = of.with_job(&mut [], |job| unsafe {
            sys::carom_plan_memory(job.options)
        });
        if bytes == 0 {
            of.with_job(&mut [], |job| check_plan(sys::CAROM_ERROR_OPTIONS, job))?;
        }
        Ok(Thinking {
            watch: Watch::new(&of.rules),
            in_hand: in_hand || of.bounds.is_some(),
            of,
            memory: vec![0.0; bytes / 8 + 1],
            choices: Vec::new(),
            most: most.clamp(1, 1000),
            begun: false,
            ended: false,
            wanted: Box::default(),
        })
    }

    /// The chances of the caller's strokes, in their order.
    pub fn chances(&self, cues: &[Cue]) -> Result<Vec<PlanStroke>, Error> {
        let mut told = vec![PlanStroke::default(); cues.len()];
        let bytes = self.with_job(&mut [], |job| unsafe {
            sys::carom_plan_memory(job.options)
        });
        let mut memory = vec![0.0; bytes / 8 + 1];
        let count = cues.len().min(c_int::MAX as usize) as c_int;
        let watch = Watch::new(&self.rules);
        self.with_job(&mut memory, |job| {
            let to = told.as_mut_ptr();
            watch.check_plan(
                unsafe { sys::carom_plan_try(job, cues.as_ptr(), count, to) },
                job,
            )
        })?;
        Ok(told)
    }

    /// The chance that the player at the table wins, without playing a shot.
    pub fn value(&self, in_hand: bool) -> Result<f64, Error> {
        let (mut value, watch) = (0.0, Watch::new(&self.rules));
        self.with_job(&mut [], |job| {
            let status = unsafe { sys::carom_plan_value(job, in_hand.into(), &mut value) };
            watch.check_plan(status, job)
        })?;
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
            leave: i64::from(i32::from(self.leave)),
            ..Default::default()
        }
    }
}

// The pointers in PlanOptions are not read; the pointers in the memory are to boxes of the same
// object.
unsafe impl Send for Position {}
unsafe impl Sync for Position {}
unsafe impl Send for Thinking {}
unsafe impl Sync for Thinking {}

/// The leave of the game after a foul that leaves the cue ball in hand.
fn leave_in_hand(of: &Position) -> Leave {
    let about = unsafe { sys::carom_rules_about_of(of.rules.learned - 1).as_ref() };
    let leave = about.and_then(|game| game.hand.try_into().ok());
    leave.unwrap_or(Leave::Anywhere)
}

/// A plan in progress.
pub struct Thinking {
    // Boxed, because the memory points to it and to the options.
    of: Box<Position>,
    wanted: Box<PlanOptions>,
    watch: Watch,
    memory: Vec<f64>,
    choices: Vec<PlanStroke>,
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
        let mut choices = vec![PlanStroke::default(); self.most];
        let (to, room) = (choices.as_mut_ptr(), self.most as c_int);
        let status = unsafe {
            if self.begun {
                sys::carom_plan_continue(&job, to, room, &mut found)
            } else if self.in_hand {
                let of = &self.of;
                let bounds = of.bounds.unwrap_or_else(|| {
                    calls::hand_bounds(of.leave, &of.table, 0.0).unwrap_or_default()
                });
                let (low, high) = (bounds.low.as_ptr(), bounds.high.as_ptr());
                sys::carom_plan_hand(&job, low, high, to, room, &mut found)
            } else {
                sys::carom_plan(&job, to, room, &mut found)
            }
        };
        self.begun = true;
        let checked = self.watch.check_plan(status, &job);
        self.ended = checked.is_err() || found > 0;
        checked?;
        choices.truncate(found as usize);
        self.choices = choices;
        Ok(self.ended)
    }

    /// The best strokes, best first; empty until the end.
    pub fn choices(&self) -> &[PlanStroke] {
        &self.choices
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        aim, built_in_rules, cue, place, rack, shoot, table, Game, Pot, PotOutcome, Race,
        TableKind, TurnOutcome,
    };

    /// A drill: any ball counts, until a miss.
    struct Drill;

    impl GameRules for Drill {
        fn on(_: &[u64; 8], in_play: u32) -> u32 {
            in_play & !1
        }
        fn judge(user: &mut [u64; 8], _: u32, _: usize, facts: &Facts, _: Call) -> Turn {
            let potted = facts.down != 0 && facts.down & 1 == 0;
            user[0] += u64::from(potted);
            Turn {
                outcome: if potted {
                    TurnOutcome::Keep
                } else {
                    TurnOutcome::Pass
                }
                .into(),
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
        let table = table(TableKind::Pool9ft).unwrap();
        let mut balls = rack(RackKind::Nineball, &table, 1e-4, 1).unwrap();
        balls.truncate(3);
        for (k, (x, y)) in [(0.6, 0.9), (0.3, 0.4), (0.9, 2.0)].into_iter().enumerate() {
            assert!(place(&table, &mut balls, k, x, y).unwrap().is_ok());
        }
        (table, balls, cue(Game::Pool))
    }

    #[test]
    fn a_rejected_member_is_named() {
        let (table, balls, cue) = layout();
        let rules = built_in_rules(RulesKind::Potting);
        let mut of = Position::new(&table, &balls, &cue, &rules, 600.0);
        of.options.shots = 60;
        let error = of.plan(1, false).unwrap_err();
        assert_eq!(error.status, Status::ErrorOptions);
        let expected = "options->shots is 60; it must be 0, or 100 to 1e6";
        assert_eq!(error.fault, expected);
        of.options.shots = 100;
        of.player.phi = -1.0;
        let error = of.plan(1, false).unwrap_err();
        let expected = "player->phi is -1; it must be 0 to 1000, in degrees";
        assert_eq!(error.fault, expected);
    }

    #[test]
    fn slices_choose_what_one_call_chooses() {
        let (table, balls, cue) = layout();
        for rules in [built_in_rules(RulesKind::Potting), rules::<Drill>()] {
            let mut of = Position::new(&table, &balls, &cue, &rules, 600.0);
            of.rules.race = Race::Alone.into();
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
            assert_eq!(of.plan(1, false).unwrap_err().status, Status::ErrorOptions);
        }
    }

    /// Rules with every callback, each of which panics where it is the one that is named.
    struct Every;
    static PANICS_IN: Mutex<&str> = Mutex::new("");

    fn ask(what: &str) {
        let named = *PANICS_IN.lock().unwrap();
        assert!(what != named, "in {what}");
    }

    impl GameRules for Every {
        fn on(_: &[u64; 8], in_play: u32) -> u32 {
            ask("on");
            in_play & !1
        }
        fn judge(_: &mut [u64; 8], _: u32, _: usize, facts: &Facts, _: Call) -> Turn {
            ask("judge");
            Turn {
                outcome: TurnOutcome::Pass.into(),
                spot: facts.down & !1,
                ..Default::default()
            }
        }
        fn left(_: &[u64; 8], _: u32) -> [i32; 2] {
            ask("left");
            [2, 2]
        }
        const POCKETS: Option<fn(&[u64; 8]) -> u32> = Some(|_| {
            ask("pockets");
            63
        });
        const VALUE: Option<fn(&[u64; 8], &[BallState], bool) -> f64> = Some(|_, layout, _| {
            ask("value");
            layout.len() as f64 / 12.0
        });
        const POINTS: Option<fn(&[u64; 8], u32, Option<usize>) -> f64> = Some(|_, _, _| {
            ask("points");
            1.0
        });
        const SETTLE: Option<fn(&mut [u64; 8], &Table, &mut [ShotBall], &mut Turn)> =
            Some(|user, table, balls, turn| {
                ask("settle");
                user[0] = 7;
                for ball in (0..balls.len()).filter(|k| turn.spot >> k & 1 != 0) {
                    spot(RackKind::Nineball, table, balls, ball).unwrap();
                }
            });
    }

    #[test]
    fn a_panic_in_any_callback_is_an_error() {
        let (table, balls, mut cue) = layout();
        let mut of = Position::new(&table, &balls, &cue, &rules::<Every>(), 600.0);
        assert_eq!(of.value(false).unwrap(), 0.25);
        let by_value = of.clone();
        of.rules.value = None; // the library's function, which requests points
        of.rules.race = Race::Points.into();
        of.options.shots = 100;
        let mut pot = Pot {
            ball: 1,
            ..Default::default()
        };
        cue.speed = 2.0;
        aim(&table, &balls, &mut pot, &mut cue, &Options::default()).unwrap();
        let shot = shoot(&table, &balls, &cue, &Options::default()).unwrap();
        let call = Call::default();
        let ruling = shot.referee(&of.rules, call, 0).unwrap();
        assert_eq!((ruling.state.user[0], ruling.put), (7, 2));
        for what in [
            "on", "judge", "left", "pockets", "value", "points", "settle",
        ] {
            *PANICS_IN.lock().unwrap() = what;
            let plan = of.plan(1, false).err();
            let value = by_value.value(false).err();
            let ruling = shot.referee(&of.rules, call, 0).err();
            let errors: Vec<Error> = [plan, value, ruling].into_iter().flatten().collect();
            assert!(!errors.is_empty(), "{what}");
            for error in errors {
                let said = format!("panicked: in {what}");
                assert!(error.fault.ends_with(&said), "{error:?}");
            }
        }
        *PANICS_IN.lock().unwrap() = "";
        assert!(of.plan(1, false).is_ok());
        assert!(rules::<Drill>().value.is_none());
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
        assert_eq!(pot.outcome, PotOutcome::Falls.into());
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
        while parts.status() == Status::StoppedAtTime {
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
        assert_eq!(parts.resume(&table, &options).unwrap(), Status::Ok);
        assert!(whole.clone().resume(&table, &options).is_err());
        let player = calls::player_fargo(400.0);
        assert_ne!(strike(&player, 1, 0, &cue).phi, cue.phi);
        pot.ball = 99;
        assert!(aim(&table, &balls, &mut pot, &mut cue, &options).is_err());
    }
}
