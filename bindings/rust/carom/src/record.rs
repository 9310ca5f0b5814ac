//! Recordings: games that verify themselves. docs/reference/files.md has the format.
use crate::{
    check, count_of, status_of, sys, text, Cue, Error, Facts, Options, Shot, ShotBall, Status,
    Table,
};
use std::os::raw::c_char;

/// A recording: read line by line and played, or written. All lines end with an end of line.
#[derive(Default)]
pub struct Recording {
    record: Box<sys::carom_record>,
    last: Option<Shot>,
}

impl Recording {
    /// Begins a game, and returns its lines up to the line of the balls.
    pub fn begin(
        &mut self,
        table: &Table,
        balls: &[ShotBall],
        options: &Options,
    ) -> Result<String, Error> {
        if balls.len() > sys::CAROM_BALLS_MOST as usize {
            check(sys::CAROM_ERROR_BALLS)?;
        }
        self.record = Box::default();
        self.record.table = *table;
        self.record.options = *options;
        self.record.count = i64::from(count_of(balls));
        self.record.balls[..balls.len()].copy_from_slice(balls);
        [
            sys::CAROM_RECORD_HEAD,
            sys::CAROM_RECORD_TABLE,
            sys::CAROM_RECORD_OPTIONS,
            sys::CAROM_RECORD_BALLS,
        ]
        .into_iter()
        .map(|kind| self.line(kind))
        .collect()
    }

    /// Plays a stroke from where the balls are, and returns its line. The shot is `last` then.
    pub fn shoot(&mut self, cue: &Cue) -> Result<String, Error> {
        self.record.cue = *cue;
        let status = self.play(sys::CAROM_RECORD_SHOT);
        self.with_fault(status)?;
        self.line(sys::CAROM_RECORD_SHOT)
    }

    /// Puts a ball at x, y (m), at rest, and returns the line.
    pub fn place(&mut self, ball: usize, x: f64, y: f64) -> Result<String, Error> {
        let ball = ball.min(i32::MAX as usize) as i32;
        let nothing = std::ptr::null_mut();
        check(unsafe { sys::carom_record_place(&mut *self.record, ball, x, y, nothing) })?;
        self.line(sys::CAROM_RECORD_PLACE)
    }

    /// Takes a ball in hand; it is out of play until it is placed. Returns the line.
    pub fn hand(&mut self, ball: usize) -> Result<String, Error> {
        let ball = ball.min(i32::MAX as usize) as i32;
        check(unsafe { sys::carom_record_hand(&mut *self.record, ball) })?;
        self.line(sys::CAROM_RECORD_PLACE)
    }

    /// The last shot that was played or read, with its events; for a continued shot, from its
    /// start.
    pub fn last(&self) -> Option<&Shot> {
        self.last.as_ref()
    }

    /// Ends the game, and returns its last line.
    pub fn end(&mut self) -> Result<String, Error> {
        self.line(sys::CAROM_RECORD_END)
    }

    /// The balls after the last shot.
    pub fn layout(&mut self) -> Result<&[ShotBall], Error> {
        check(unsafe { sys::carom_record_settle(&mut *self.record) })?;
        Ok(&self.record.balls[..self.record.count as usize])
    }

    /// The facts of the last shot, for rules.
    pub fn facts(&self) -> &Facts {
        &self.record.facts
    }

    fn play(&mut self, kind: sys::carom_record_kind) -> sys::carom_status {
        let (before, goes_on) = (self.record.clone(), kind == sys::CAROM_RECORD_CONTINUE);
        let record: *mut sys::carom_record = &mut *self.record;
        unsafe {
            Shot::of_record(
                record,
                (*record).balls.as_ptr(),
                &mut self.last,
                goes_on,
                |to| {
                    *record = *before;
                    sys::carom_record_play(record, kind, to)
                },
            )
        }
    }

    fn with_fault(&self, status: sys::carom_status) -> Result<(), Error> {
        if status == sys::CAROM_ERROR_RECORD {
            let fault = text(self.record.fault.as_ptr());
            return Err(Error {
                status: status_of(status),
                fault,
            });
        }
        check(status).map(|_| ())
    }

    fn line(&mut self, kind: sys::carom_record_kind) -> Result<String, Error> {
        let mut line = vec![0u8; sys::CAROM_RECORD_TEXT as usize];
        let to = line.as_mut_ptr() as *mut c_char;
        let size = unsafe { sys::carom_record_write(&mut *self.record, kind, to, line.len()) };
        if size == 0 {
            return Err(Error {
                status: Status::ErrorRecord,
                fault: "this line is not allowed here".to_string(),
            });
        }
        line.truncate(size);
        Ok(String::from_utf8(line).expect("a recording is ASCII"))
    }

    /// Reads a line, and plays its shot if it has one. Returns whether every bit is the recorded
    /// one.
    pub fn read(&mut self, line: &str) -> Result<bool, Error> {
        let record = &mut *self.record;
        let status =
            unsafe { sys::carom_record_read(record, line.as_ptr() as *const c_char, line.len()) };
        if status < 0 {
            let fault = text(record.fault.as_ptr());
            return Err(Error {
                status: status_of(status),
                fault,
            });
        }
        if record.pending != i64::from(sys::CAROM_PENDING_SHOT) {
            return Ok(true);
        }
        let kind = record.kind as sys::carom_record_kind;
        let status = self.play(kind);
        if status == sys::CAROM_ERROR_RECORD {
            self.with_fault(status)?;
        }
        // A shot in error is recorded with its status, so its bits count as well.
        let (is, was) = (&self.record.played, &self.record.recorded);
        Ok(i64::from(status) == is.status
            && (is.status, is.events, is.time.to_bits(), is.hash)
                == (was.status, was.events, was.time.to_bits(), was.hash))
    }

    /// Reads lines up to a shot with other bits than were recorded, and returns false there. A game
    /// that was saved without its end can be continued.
    pub fn load(&mut self, lines: &str) -> Result<bool, Error> {
        let mut all = lines.lines();
        all.try_fold(true, |same, line| Ok(same && self.read(line)?))
    }

    /// Shots so far.
    pub fn shots(&self) -> i64 {
        self.record.shots
    }

    /// Whether the last line was the end; without it a recording was cut off.
    pub fn ended(&self) -> bool {
        self.record.kind == i64::from(sys::CAROM_RECORD_END)
    }

    /// The hash of all lines so far.
    pub fn hash(&self) -> u64 {
        self.record.hash
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{cue, rack, table, Game, RackKind, TableKind};

    #[test]
    fn no_stroke_while_balls_move() -> Result<(), Error> {
        let table = table(TableKind::Pool9ft)?;
        let balls = rack(RackKind::Nineball, &table, 1e-4, 1)?;
        let stop = Options {
            time_most: 0.5,
            ..Options::default()
        };
        let stroke = Cue {
            speed: 8.0,
            ..cue(Game::Pool)
        };
        let mut game = Recording::default();
        game.begin(&table, &balls, &stop)?;
        game.shoot(&stroke)?;
        let refused = game.shoot(&stroke).unwrap_err();
        assert!(refused.fault.contains("balls move"), "{refused:?}");
        Ok(())
    }

    #[test]
    fn what_is_written_is_read_with_the_same_bits() {
        let table = table(TableKind::Pool9ft).unwrap();
        let balls = rack(RackKind::Nineball, &table, 1e-4, 1).unwrap();
        let mut game = Recording::default();
        assert!(game.end().is_err());
        let mut lines = game.begin(&table, &balls, &Options::default()).unwrap();
        for speed in [8.0, 3.0] {
            let stroke = Cue {
                speed,
                ..cue(Game::Pool)
            };
            lines += &game.hand(0).unwrap();
            lines += &game.place(0, 0.5, 0.3).unwrap();
            lines += &game.shoot(&stroke).unwrap();
        }
        assert!(game.place(99, 0.5, 0.3).is_err());
        lines += &game.end().unwrap();
        let mut read = Recording::default();
        assert!(read.load(&lines).unwrap());
        assert!(read.ended() && game.hand(99).is_err());
        let (one, other) = (game.last().unwrap(), read.last().unwrap());
        let same = |(a, b): (&crate::Event, &crate::Event)| a.time == b.time;
        assert!(one.events().iter().zip(other.events()).all(same));
        assert!(one.events().len() > 5 && one.facts().moved == game.facts().moved);
        assert_eq!((read.shots(), read.hash()), (2, game.hash()));
        let (one, other) = (game.layout().unwrap(), read.layout().unwrap());
        assert!(one.iter().zip(other).all(|(a, b)| a.state.r == b.state.r));
    }
}
