//! Billiards with the C library carom: tables, racks, complete shots, plans and recordings. `calls`
//! has the other functions that need no pointers, and `sys` has all functions as C declares them.
//!
//! ```
//! use carom::{Error, Game, RackKind, TableKind};
//! # fn main() -> Result<(), Error> {
//! let table = carom::table(TableKind::Pool9ft)?;
//! let balls = carom::rack(RackKind::Nineball, &table, 1e-4, 1)?;
//! let cue = carom::Cue { speed: 8.0, ..carom::cue(Game::Pool) };
//! let shot = carom::shoot(&table, &balls, &cue, &carom::Options::default())?;
//! assert_eq!(shot.at(shot.time())?.len(), 10);
//! # Ok(())
//! # }
//! ```
//!
//! Units are SI; directions of a cue are in degrees. A shot has the same bits on all machines,
//! unless `fast` is set.
#[rustfmt::skip] // written by bindings/write.py
pub mod calls;
mod match_game;
mod names;
mod plan;
mod record;

pub use calls::{
    cue_of as cue, physics_revision, plan_rules_of as built_in_rules, ruling_string as words,
    table_make as table, table_measures as measures, word,
};
pub use carom_sys as sys;
pub use match_game::Match;
pub use names::{named, names, Named};
pub use plan::{rules, spot, strike, GameRules, Position, Thinking};
pub use record::Recording;
pub use sys::words::*;
pub use sys::{
    carom_ball_state as BallState, carom_bounds as Bounds, carom_call as Call, carom_cue as Cue,
    carom_event as Event, carom_facts as Facts, carom_measures as Measures,
    carom_plan_options as PlanOptions, carom_plan_rules as Rules, carom_plan_stroke as PlanStroke,
    carom_player as Player, carom_pot as Pot, carom_rules_state as RulesState,
    carom_ruling as Ruling, carom_shot_ball as ShotBall, carom_shot_options as Options,
    carom_table as Table, carom_turn as Turn,
};

use std::ffi::CStr;
use std::fmt;
use std::os::raw::c_char;

/// The error of a call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    pub status: Status,
    /// The fault of the line of a recording, or of the number of a shot.
    pub fault: String,
}

impl fmt::Display for Error {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let words = calls::status_string(self.status).unwrap_or_default();
        if self.fault.is_empty() {
            write!(to, "{words}")
        } else if self.status == Status::ErrorRecord {
            write!(to, "{words}: {}", self.fault)
        } else {
            write!(to, "{}", self.fault)
        }
    }
}

impl std::error::Error for Error {}

fn text(from: *const c_char) -> String {
    unsafe { CStr::from_ptr(from) }
        .to_string_lossy()
        .into_owned()
}

fn optional_text(from: *const c_char) -> Option<String> {
    (!from.is_null()).then(|| text(from))
}

/// The text of a function that returns the length of the complete text.
fn written(write: impl Fn(*mut c_char, usize) -> usize) -> String {
    let mut bytes = vec![0u8; write(std::ptr::null_mut(), 0) + 1];
    write(bytes.as_mut_ptr().cast(), bytes.len());
    text(bytes.as_ptr().cast())
}

/// A number of a ball, a cue or a table, or an option: its names, unit, range as a text, default,
/// and description.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    pub name: String,
    pub key: String,
    pub unit: String,
    pub range: String,
    pub text: String,
    pub low: f64,
    pub high: f64,
    /// An allowed value outside the range: 0, for a default, or -1; NaN: none.
    pub other: f64,
}

/// The numbers of a part, such as `PartKind::Ball`, or the options of a call, as the library
/// describes them.
pub fn rows(part: PartKind) -> Vec<Row> {
    let row = |k| unsafe { sys::carom_number_of(part.into(), k).as_ref() };
    let told = |one: &sys::carom_number| {
        let mut range = [0 as c_char; 200];
        unsafe { sys::carom_number_range(one, range.as_mut_ptr(), range.len()) };
        Row {
            name: text(one.name),
            key: text(one.key),
            unit: text(one.unit),
            range: text(range.as_ptr()),
            text: text(one.text),
            low: one.low,
            high: one.high,
            other: one.other,
        }
    };
    (0..).map_while(row).map(told).collect()
}

/// The error of a shot, with the invalid number if there is one.
fn refused(
    status: sys::carom_status,
    table: &Table,
    balls: &[ShotBall],
    cue: &Cue,
    options: &Options,
) -> Error {
    let mut fault = sys::carom_fault::default();
    let mut must = [0 as c_char; 200];
    unsafe {
        sys::carom_shot_fault(
            table,
            balls.as_ptr(),
            balls.len() as i32,
            cue,
            options,
            &mut fault,
            must.as_mut_ptr(),
            must.len(),
        )
    };
    let (row, must) = (unsafe { fault.row.as_ref() }, text(must.as_ptr()));
    Error {
        status: status_of(status),
        fault: row
            .filter(|_| !must.is_empty())
            .map_or(String::new(), |row| {
                format!("{} must be {must}, not {}", text(row.name), fault.value)
            }),
    }
}

fn check(status: sys::carom_status) -> Result<Status, Error> {
    let (code, status, fault) = (status, status_of(status), String::new());
    if code < 0 {
        return Err(Error { status, fault });
    }
    Ok(status)
}

fn status_of(code: sys::carom_status) -> Status {
    Status::try_from(code).expect("the library is of the version of carom-sys")
}

/// A table from its measures, checked for balls of a radius, m. The error names the invalid
/// measure.
pub fn table_measured(measures: &Measures, radius: f64) -> Result<Table, Error> {
    let (mut table, mut at) = (Table::default(), sys::carom_table_fault::default());
    let status = unsafe { sys::carom_table_measured(measures, radius, &mut table, &mut at) };
    if at.part.kind == sys::CAROM_PART_MEASURES {
        let fault = rows(PartKind::Measures)
            .swap_remove(at.part.index as usize)
            .name;
        let status = status_of(status);
        return Err(Error { status, fault });
    }
    check(status)?;
    Ok(table)
}

/// A rack, with the cue ball first. `gap`, m, is between neighbours; `seed` draws the
/// displacements.
pub fn rack(kind: RackKind, table: &Table, gap: f64, seed: u64) -> Result<Vec<ShotBall>, Error> {
    let size = unsafe { sys::carom_rack_size(kind.into()) };
    let mut balls = vec![ShotBall::default(); size as usize];
    check(unsafe { sys::carom_rack(kind.into(), table, gap, seed, balls.as_mut_ptr(), size) })?;
    Ok(balls)
}

/// Ball in hand: puts a ball at rest at x, y (m). `Ok(Err(part))` if that position is not free: the
/// part is in the way, and the ball does not move.
pub fn place(
    table: &Table,
    balls: &mut [ShotBall],
    ball: usize,
    x: f64,
    y: f64,
) -> Result<Result<(), sys::carom_part>, Error> {
    let mut part = sys::carom_part::default();
    let (count, ball) = (count_of(balls), ball.min(i32::MAX as usize) as i32);
    let status =
        unsafe { sys::carom_place_ball(table, balls.as_mut_ptr(), count, ball, x, y, &mut part) };
    if status == sys::CAROM_ERROR_OVERLAP || status == sys::CAROM_ERROR_OFF_TABLE {
        return Ok(Err(part));
    }
    check(status)?;
    Ok(Ok(()))
}

/// Aims a pot: `cue.phi` becomes the direction in which `pot.ball` goes to the middle of
/// `pot.pocket`, by way of `pot.via`. `pot.outcome` is the result with the other balls and the
/// jaws.
pub fn aim(
    table: &Table,
    balls: &[ShotBall],
    pot: &mut Pot,
    cue: &mut Cue,
    options: &Options,
) -> Result<(), Error> {
    let aimed = *cue;
    let status =
        unsafe { sys::carom_aim(table, balls.as_ptr(), count_of(balls), options, pot, cue) };
    if status < 0 {
        return Err(refused(status, table, balls, &aimed, options));
    }
    Ok(())
}

/// The number of balls in the type of the library, which rejects numbers that are too large.
fn count_of(balls: &[ShotBall]) -> i32 {
    balls.len().min(i32::MAX as usize) as i32
}

/// A shot that was played.
#[derive(Clone, Debug)]
pub struct Shot {
    facts: Facts,
    status: Status,
    events: Vec<Event>,
    last: Vec<BallState>,
    time: f64,
    table: Table,
    balls: Vec<ShotBall>,
    /// The state at the stop, for a shot whose options may stop it.
    state: Option<Box<sys::carom_shot_state>>,
}

/// Plays a shot until nothing moves, or until the options stop it.
pub fn shoot(
    table: &Table,
    balls: &[ShotBall],
    cue: &Cue,
    options: &Options,
) -> Result<Shot, Error> {
    let stops = options.time_most > 0.0 || options.stop_at != 0 || options.first_of != 0;
    let mut shot = Shot::begun(table, balls, stops);
    // Most shots have fewer events.
    shot.follow(256, |of, count, to| unsafe {
        sys::carom_shoot(table, of, count, cue, options, to)
    })
    .map_err(|status| refused(status, table, balls, cue, options))?;
    Ok(shot)
}

impl Shot {
    fn begun(table: &Table, balls: &[ShotBall], stops: bool) -> Self {
        Shot {
            facts: Facts::default(),
            status: Status::Ok,
            events: Vec::new(),
            last: vec![BallState::default(); balls.len()],
            time: 0.0,
            table: *table,
            balls: balls.to_vec(),
            state: stops.then(Box::default),
        }
    }

    /// `Status::Ok`, or that the options stopped it.
    pub fn status(&self) -> Status {
        self.status
    }

    /// All events, in the order in which they happened.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// The states at the end, one for each ball.
    pub fn last(&self) -> &[BallState] {
        &self.last
    }

    /// The time up to which the shot was followed, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The facts for rules.
    pub fn facts(&self) -> &Facts {
        &self.facts
    }

    /// Continues a shot that its options stopped, with the bits of the uninterrupted shot;
    /// `options` set when to stop again. After an error the shot is as before.
    pub fn resume(&mut self, table: &Table, options: &Options) -> Result<Status, Error> {
        if self.state.is_none() {
            return check(sys::CAROM_ERROR_STATE);
        }
        let before = self.clone();
        let room = self.events.len() + 64;
        self.follow(room, |of, count, to| unsafe {
            sys::carom_shot_continue(table, of, count, options, to)
        })
        .map_err(|status| {
            let cue = cue(Game::Pool);
            let error = refused(status, table, &before.balls, &cue, options);
            *self = before;
            error
        })
    }

    /// Plays from the current state of the shot, with room for `room` events; plays again if there
    /// were more.
    fn follow(
        &mut self,
        mut room: usize,
        play: impl Fn(*const ShotBall, i32, *mut sys::carom_shot) -> sys::carom_status,
    ) -> Result<Status, sys::carom_status> {
        let (happened, state) = (self.events.len(), self.state.clone());
        loop {
            self.events.resize(room, Event::default());
            let mut shot = sys::carom_shot {
                facts: &mut self.facts,
                events: self.events.as_mut_ptr(),
                room: room as i64,
                r#final: self.last.as_mut_ptr(),
                state: self
                    .state
                    .as_mut()
                    .map_or(std::ptr::null_mut(), |state| &mut **state),
                ..Default::default()
            };
            let status = play(self.balls.as_ptr(), count_of(&self.balls), &mut shot);
            if status < 0 || shot.count <= shot.room {
                self.events
                    .truncate(shot.count.clamp(0, shot.room) as usize);
                self.time = shot.time;
                self.status = status_of(status);
                return if status < 0 {
                    Err(status)
                } else {
                    Ok(self.status)
                };
            }
            room = shot.count as usize;
            self.events.truncate(happened);
            self.state = state.clone();
        }
    }

    /// Plays a stroke of a recording or a match, with room for all its events; `play` may be called
    /// again, and begins from the record as it was. `last` becomes the shot.
    unsafe fn of_record(
        record: *const sys::carom_record,
        balls: *const ShotBall,
        last: &mut Option<Shot>,
        goes_on: bool,
        play: impl Fn(*mut sys::carom_shot) -> sys::carom_status,
    ) -> sys::carom_status {
        let before = &*record;
        let count = before.count.clamp(0, i64::from(sys::CAROM_BALLS_MOST)) as usize;
        let begun = last.take().filter(|_| goes_on);
        let mut shot = begun.unwrap_or_else(|| {
            let balls = unsafe { std::slice::from_raw_parts(balls, count) };
            Shot::begun(&before.table, balls, false)
        });
        let room = shot.events.len() + 256;
        let played = shot.follow(room, |_, _, to| play(to));
        let after = &*record;
        shot.facts = after.facts;
        shot.last = after.r#final[..count].to_vec();
        *last = Some(shot);
        played.map_or_else(|error| error, i32::from)
    }

    /// The layout after the shot.
    pub fn layout(&self) -> Vec<ShotBall> {
        let after = |(ball, state): (&ShotBall, &BallState)| ShotBall {
            kind: ball.kind,
            state: *state,
        };
        self.balls.iter().zip(&self.last).map(after).collect()
    }

    /// The states at a time for drawing, s: pocketed balls fall in their pockets.
    pub fn drawn(&self, table: &Table, time: f64) -> Result<Vec<BallState>, Error> {
        let mut states = vec![BallState::default(); self.balls.len()];
        let (shot, count) = (self.data(), self.balls.len() as i32);
        let (balls, to) = (self.balls.as_ptr(), states.as_mut_ptr());
        check(unsafe { sys::carom_shot_drawn(table, balls, count, &shot, &time, 1, to) })?;
        Ok(states)
    }

    /// The slip between the surfaces in an event, m/s. Together with the impulse it determines the
    /// sound.
    pub fn slip(&self, of: &Event) -> f64 {
        calls::event_slip(&self.table, &self.balls, of)
    }

    /// The ruling of the shot; the rules have the state of the game before it.
    pub fn referee(&self, rules: &Rules, call: Call, cue_ball: i32) -> Result<Ruling, Error> {
        let (mut facts, mut last, mut made) = (self.facts, self.last.clone(), Ruling::default());
        let (balls, count) = (self.balls.as_ptr(), count_of(&self.balls));
        let seen = sys::carom_shot {
            facts: &mut facts,
            r#final: last.as_mut_ptr(),
            ..Default::default()
        };
        let (on, to, watch) = (&self.table, &mut made, plan::Watch::new(rules));
        watch.check(unsafe {
            sys::carom_referee(rules, on, balls, count, cue_ball, &seen, call, to)
        })?;
        Ok(made)
    }

    /// What the library reads of it.
    fn data(&self) -> sys::carom_shot {
        sys::carom_shot {
            // It is read only.
            events: self.events.as_ptr() as *mut Event,
            room: self.events.len() as i64,
            count: self.events.len() as i64,
            time: self.time,
            slope_x: self.table.slope_x,
            slope_y: self.table.slope_y,
            ..Default::default()
        }
    }

    /// The states of all balls at a time, s.
    pub fn at(&self, time: f64) -> Result<Vec<BallState>, Error> {
        let mut states = vec![BallState::default(); self.balls.len()];
        let shot = self.data();
        let count = self.balls.len() as i32;
        check(unsafe {
            sys::carom_shot_at(self.balls.as_ptr(), count, &shot, time, states.as_mut_ptr())
        })?;
        Ok(states)
    }
}

/// The frames of shots, for drawing, in which pocketed balls fall: each frame continues from the
/// previous one if that was earlier in the same shot.
#[derive(Default)]
pub struct Film {
    onward: Box<sys::carom_frames>,
    states: Vec<BallState>,
    turned: Vec<[f64; 4]>,
}

impl Film {
    /// The states of all balls at a time, s, and how they have turned since the start of the shot:
    /// w, x, y, z.
    pub fn at(&mut self, shot: &Shot, time: f64) -> Result<(&[BallState], &[[f64; 4]]), Error> {
        self.states.resize(shot.balls.len(), BallState::default());
        self.turned.resize(shot.balls.len(), [0.0; 4]);
        let (balls, count, data) = (shot.balls.as_ptr(), count_of(&shot.balls), shot.data());
        let (onward, states) = (&mut *self.onward, self.states.as_mut_ptr());
        let turned = self.turned.as_mut_ptr();
        check(unsafe {
            sys::carom_shot_frames(balls, count, &data, &time, 1, onward, states, turned)
        })?;
        check(unsafe {
            sys::carom_shot_falls(&shot.table, balls, count, &data, &time, 1, states)
        })?;
        Ok((&self.states, &self.turned))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_say_what_is_wrong() {
        let table = table(TableKind::Pool9ft).unwrap();
        let balls = rack(RackKind::Nineball, &table, 1e-4, 1).unwrap();
        let wrong = Cue {
            speed: -1.0,
            ..cue(Game::Pool)
        };
        let error = shoot(&table, &balls, &wrong, &Options::default()).unwrap_err();
        assert_eq!(error.status, Status::ErrorCueSpeed);
        assert_eq!(error.to_string(), "speed must be 0 to 1000, in m/s, not -1");
        let mut wide = measures(TableKind::Pool9ft).unwrap();
        assert_eq!(table_measured(&wide, 0.028575).unwrap().width, table.width);
        wide.side_mouth = 2.0;
        assert!(table_measured(&wide, 0.028575)
            .unwrap_err()
            .to_string()
            .contains("side_mouth"));
        assert_eq!(TableKind::try_from(99), Err(99));
        assert_eq!(
            rack(RackKind::Nineball, &table, f64::NAN, 1)
                .unwrap_err()
                .status,
            Status::ErrorRack
        );
        let mut damaged = Recording::default();
        let error = damaged.read("{\"game\":1}").unwrap_err();
        assert!(!damaged.ended());
        assert_eq!(error.status, Status::ErrorRecord);
        assert!(error.fault.contains("game"), "{}", error.fault);
    }

    #[test]
    fn each_number_of_a_ball_is_refused_by_its_row() {
        let table = table(TableKind::Pool9ft).unwrap();
        let balls = rack(RackKind::Nineball, &table, 1e-4, 1).unwrap();
        let all = rows(PartKind::Ball);
        assert_eq!(all.len() * 8, std::mem::size_of_val(&balls[0].kind));
        for (k, row) in all.iter().enumerate() {
            let mut bad = balls.clone();
            // A kind contains only numbers, in the order of the rows.
            unsafe {
                *(&mut bad[2].kind as *mut sys::carom_ball_kind as *mut f64).add(k) = f64::NAN
            };
            let cue = cue(Game::Pool);
            let error = shoot(&table, &bad, &cue, &Options::default()).unwrap_err();
            assert_eq!(
                error.fault,
                format!("{} must be {}, not NaN", row.name, row.range)
            );
        }
        let han = ShotCushion::Han.into();
        assert_eq!(word(Words::ShotCushion, han).unwrap(), "han");
        assert_eq!(word(Words::ShotCushion, 99), None);
    }

    #[test]
    fn states_end_where_the_shot_does() {
        let table = table(TableKind::Snooker).unwrap();
        let balls = rack(RackKind::Snooker, &table, 0.0, 1).unwrap();
        let hard = Cue {
            speed: 6.0,
            ..cue(Game::Snooker)
        };
        let shot = shoot(&table, &balls, &hard, &Options::default()).unwrap();
        assert!(shot.events.len() > 20);
        for (state, last) in shot.at(shot.time + 1.0).unwrap().iter().zip(&shot.last) {
            assert_eq!(state.r, last.r);
        }
        assert!(shot.at(f64::NAN).is_err());
        assert_eq!(shot.facts().first[0], shot.events[1].b);
        assert_eq!(shot.drawn(&table, 0.5).unwrap().len(), 22);
        assert_eq!(shot.layout()[5].state.r, shot.last[5].r);
        let mut layout = balls.clone();
        let [x, y, _] = layout[3].state.r;
        let part = place(&table, &mut layout, 0, x, y).unwrap().unwrap_err();
        assert_eq!((part.kind, part.index), (PartKind::Ball.into(), 3));
        assert!(place(&table, &mut layout, 0, 0.5, 0.31).unwrap().is_ok());
        assert_eq!(layout[0].state.r[1], 0.31);
        assert!(place(&table, &mut layout, 99, 0.5, 0.3).is_err());
        let mut film = Film::default();
        for time in [0.1, 1.0, 1.0, 0.5] {
            let (states, turned) = film.at(&shot, time).unwrap();
            for (k, state) in shot.drawn(&table, time).unwrap().iter().enumerate() {
                assert_eq!((state.r, state.w), (states[k].r, states[k].w));
                let size: f64 = turned[k].iter().map(|x| x * x).sum();
                assert!((size - 1.0).abs() < 1e-12);
            }
        }
        assert!(film.at(&shot, f64::NAN).is_err());
    }
}
