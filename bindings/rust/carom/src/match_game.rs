//! Matches: one object that knows the rules, and writes its recording.
use crate::{
    check, count_of, status_of, sys, text, words, Cue, Error, Leave, MatchPhase, Options,
    PlanStroke, Position, RulesKind, Ruling, Shot, ShotBall, Status, Table,
};
use std::os::raw::c_char;

/// A match of `carom_match.h`. An act that the rules forbid returns an error that describes what
/// would be right, and changes nothing.
pub struct Match {
    pub(crate) of: Box<sys::carom_match>,
    scratch: Box<sys::carom_record>,
    room: Box<sys::carom_match>,
    /// With the lines that the match has made, also those that are due in a file.
    lines: String,
    /// The members `size`, `known` and `due` of `of`: how many bytes of its text are what. A
    /// refused act changes them, and not the bytes.
    sizes: [i64; 3],
    undone: Vec<String>,
    last: Option<Shot>,
}

impl Match {
    /// Begins a match with the rack of a game; `side` 0 or 1 breaks.
    pub fn begin(rules: RulesKind, table: &Table, seed: u64, side: usize) -> Result<Match, Error> {
        Match::begin_to(rules, 0, false, table, seed, side)
    }

    /// The same to `target` points, 0: the usual target of the game; with `equal_innings` the match
    /// may be drawn.
    pub fn begin_to(
        rules: RulesKind,
        target: i32,
        equal_innings: bool,
        table: &Table,
        seed: u64,
        side: usize,
    ) -> Result<Match, Error> {
        Match::begin_with(&sys::carom_match_setup {
            rules: rules.into(),
            target,
            equal_innings: equal_innings.into(),
            table,
            seed,
            side: side as i64,
            ..Default::default()
        })
    }

    /// The same from any layout, by the rules of this kind; the cue ball is in hand if `leave` says
    /// so.
    pub fn begin_at(
        rules: RulesKind,
        table: &Table,
        balls: &[ShotBall],
        leave: Leave,
        side: usize,
    ) -> Result<Match, Error> {
        Match::begin_with(&sys::carom_match_setup {
            rules: rules.into(),
            table,
            balls: balls.as_ptr(),
            count: count_of(balls).into(),
            leave: leave.into(),
            side: side as i64,
            ..Default::default()
        })
    }

    /// The same with any seats, which `seating_make` initializes: names, sides, handicaps, cues and
    /// limits; and optionally with a set. `side` breaks.
    pub fn begin_seats(
        rules: RulesKind,
        table: &Table,
        seed: u64,
        seating: &sys::carom_seating,
        set: Option<&sys::carom_set>,
        side: usize,
    ) -> Result<Match, Error> {
        Match::begin_with(&sys::carom_match_setup {
            rules: rules.into(),
            table,
            seed,
            seating,
            set: set.map_or(std::ptr::null(), |of| of),
            side: side as i64,
            ..Default::default()
        })
    }

    fn begin_with(setup: &sys::carom_match_setup) -> Result<Match, Error> {
        let mut made = Match::empty();
        let status = unsafe { sys::carom_match_begin_with(&mut *made.of, setup) };
        made.told(status)?;
        Ok(made)
    }

    /// Reads and judges the lines of a match. The last shot has all its events, also if balls are
    /// still moving.
    pub fn load(lines: &str) -> Result<Match, Error> {
        if lines.is_empty() {
            let fault = "the text is empty: a match begins with a recording line".to_string();
            let status = Status::ErrorRecord;
            return Err(Error { status, fault });
        }
        let mut made = Match::empty();
        made.read_all(lines)?;
        Ok(made)
    }

    fn read_all(&mut self, lines: &str) -> Result<(), Error> {
        *self.of = Default::default();
        self.lines.clear();
        self.keep_sizes();
        for line in lines.split_inclusive('\n') {
            self.read_line(line)?;
        }
        self.replay()
    }

    /// Reads a line of a file. `lines` has the lines that are still due already, at its end, and a
    /// note comes before them.
    fn read_line(&mut self, line: &str) -> Result<(), Error> {
        let state = |of: &sys::carom_match| (of.record.line, of.record.hash);
        let (previous, due) = (state(&self.of), self.of.due as usize);
        let at = line.as_ptr() as *const c_char;
        let status =
            unsafe { sys::carom_match_read(&mut *self.of, &mut *self.scratch, at, line.len()) };
        self.refused(status)?;

        // No blank line, no event, and none that was due.
        let is_new = state(&self.of) != previous;
        if is_new {
            let place = self.lines.len() - due;
            self.lines
                .insert_str(place, &format!("{}\n", line.trim_end()));
        }
        if is_new && due == 0 {
            self.keep_lines();
        } else {
            self.keep_sizes();
        }
        Ok(())
    }

    /// Reads the next line of a file. Nothing is read behind a line that is not by the rules.
    pub fn read(&mut self, line: &str) -> Result<(), Error> {
        let shots = self.shots();
        self.read_line(line)?;
        self.undone.clear();
        if self.shots() == shots {
            return Ok(());
        }
        self.replay()
    }

    /// Judges a line that a peer of this seat has sent, as `carom_match_receive` does; `None`: a
    /// sender that may send every line. An error leaves the match as it was. Returns whether the
    /// match has changed; `lines` then has new ones.
    pub fn receive(&mut self, line: &str, seat: Option<usize>) -> Result<bool, Error> {
        let (shots, line_count) = (self.shots(), self.of.record.line);
        let at = line.as_ptr() as *const c_char;
        let seat = seat.map_or(-1, |seat| seat as i32);
        let status = unsafe {
            sys::carom_match_receive(&mut *self.of, &mut *self.room, at, line.len(), seat)
        };
        self.refused(status)?;
        if self.of.record.line == line_count {
            return Ok(false);
        }
        self.undone.clear();
        if self.of.size == 0 {
            // A line of the beginning, which is read and not made.
            self.lines += &format!("{}\n", line.trim_end());
        }
        self.keep_lines();
        if self.shots() != shots {
            self.replay()?;
        }
        Ok(true)
    }

    /// The last shot of a match that was read, with all its events.
    fn replay(&mut self) -> Result<(), Error> {
        self.last = None;
        if self.of.stroke.mass <= 0.0 {
            return Ok(());
        }
        let of: *mut sys::carom_match = &mut *self.of;
        let status = unsafe {
            Shot::of_record(
                &(*of).record,
                (*of).before.as_ptr(),
                &mut self.last,
                false,
                |to| sys::carom_match_replay(of, to),
            )
        };
        check(status).map(|_| ())
    }

    /// Undoes the last act. False: there is nothing to undo.
    pub fn undo(&mut self) -> Result<bool, Error> {
        let (at, length) = (self.lines.as_ptr() as *const c_char, self.lines.len());
        let size = unsafe { sys::carom_match_undone(at, length) };
        if size == length {
            return Ok(false);
        }
        let lines = self.lines.clone();
        self.read_all(&lines[..size])?;
        self.undone.push(lines[size..].to_string());
        Ok(true)
    }

    /// Repeats the act that was undone last. False: there is nothing to repeat.
    pub fn redo(&mut self) -> Result<bool, Error> {
        let act = match self.undone.pop() {
            Some(act) => act,
            None => return Ok(false),
        };
        let lines = format!("{}{act}", self.lines);
        self.read_all(&lines)?;
        Ok(true)
    }

    /// A copy of the match, independent of this one.
    pub fn copy(&self) -> Result<Match, Error> {
        let mut made = Match::empty();
        made.of = self.of.clone();
        made.lines = self.lines.clone();
        made.keep_sizes();
        made.replay()?;
        Ok(made)
    }

    fn empty() -> Match {
        Match {
            of: Box::default(),
            scratch: Box::default(),
            room: Box::default(),
            lines: String::new(),
            sizes: [0; 3],
            undone: Vec::new(),
            last: None,
        }
    }

    /// Keeps the lines of an act; returns an error for a rejected act.
    pub(crate) fn told(&mut self, status: sys::carom_status) -> Result<(), Error> {
        if status < 0 && self.of.size == 0 {
            return self.refused(status);
        }
        self.keep_lines(); // also those of `prepare` before an act that is refused
        self.undone.clear();
        self.judged(status)
    }

    /// Adds the lines that the match has made.
    fn keep_lines(&mut self) {
        self.lines += &self.pending();
        self.keep_sizes();
    }

    fn keep_sizes(&mut self) {
        self.sizes = [self.of.size, self.of.known, self.of.due];
    }

    /// The lines of the last act, or those that are still missing.
    fn pending(&self) -> String {
        let bytes = self.of.text[..self.of.size as usize].iter();
        String::from_utf8_lossy(&bytes.map(|&one| one as u8).collect::<Vec<_>>()).into_owned()
    }

    /// The result of a line or of an act that was perhaps refused; the lines that are due stay due.
    fn refused(&mut self, status: sys::carom_status) -> Result<(), Error> {
        if status < 0 {
            [self.of.size, self.of.known, self.of.due] = self.sizes;
        }
        self.judged(status)
    }

    fn judged(&self, status: sys::carom_status) -> Result<(), Error> {
        if status < 0 && self.of.fault[0] != 0 {
            let (status, fault) = (status_of(status), text(self.of.fault.as_ptr()));
            return Err(Error { status, fault });
        }
        check(status).map(|_| ())
    }

    /// The complete state of the match: phase, choices, bounds and record.
    pub fn state(&self) -> &sys::carom_match {
        &self.of
    }

    /// Whether the match is over.
    pub fn is_over(&self) -> bool {
        self.phase() == MatchPhase::Over
    }

    /// The last shot, with all its events.
    pub fn last(&self) -> Option<&Shot> {
        self.last.as_ref()
    }

    /// The position of the player at the table, for plans of a player with a rating; in hand, with
    /// the bounds of the match.
    pub fn position(&self, cue: &Cue, rating: f64) -> Position {
        let (of, ball) = (&self.of.record, self.of.cue_ball.into());
        let balls = &of.balls[..of.count as usize];
        let cue = Cue { ball, ..*cue };
        let mut made = Position::new(&of.table, balls, &cue, &self.of.rules, rating);
        made.shot = of.options;
        made.leave = self.of.leave.try_into().unwrap_or(Leave::After);
        made.bounds = (self.phase() == MatchPhase::Place).then_some(self.of.bounds);
        made
    }

    /// The recording so far, with the lines that were missing in a text that was read and cut off.
    pub fn lines(&self) -> &str {
        &self.lines
    }

    /// The last ruling.
    pub fn ruling(&self) -> &Ruling {
        &self.of.ruling
    }

    /// Plays a stroke; `stop` sets when its shot is stopped. Returns whether the shot has ended,
    /// and was judged.
    pub fn stroke(&mut self, cue: &Cue, stop: &Options) -> Result<bool, Error> {
        let seat = self.at_table();
        self.play(false, |of, to| unsafe {
            sys::carom_match_stroke(of, seat, cue, stop, to)
        })
    }

    /// Continues a stopped shot in the same way.
    pub fn go_on(&mut self, stop: &Options) -> Result<bool, Error> {
        self.play(true, |of, to| unsafe {
            sys::carom_match_continue(of, stop, to)
        })
    }

    fn play(
        &mut self,
        goes_on: bool,
        once: impl Fn(*mut sys::carom_match, *mut sys::carom_shot) -> sys::carom_status,
    ) -> Result<bool, Error> {
        let (before, of): (_, *mut sys::carom_match) = (self.of.clone(), &mut *self.of);
        let status = unsafe {
            let balls = (*of).record.balls.as_ptr();
            Shot::of_record(&(*of).record, balls, &mut self.last, goes_on, |to| {
                *of = *before;
                once(of, to)
            })
        };
        self.told(status)?;
        Ok(status == sys::CAROM_OK)
    }

    /// A seat concedes the game.
    pub fn concede(&mut self, seat: usize) -> Result<(), Error> {
        let seat = seat.min(sys::CAROM_SEATS_MOST as usize) as i32;
        let status = unsafe { sys::carom_match_concede(&mut *self.of, seat) };
        self.told(status)
    }

    /// Writes words into the recording: texts by their keys, such as `("comment", "a kiss")`, and
    /// the time in s that the last stroke took the player, 0: none. docs/reference/files.md has the
    /// keys; those of a caller begin with `x_`. `seat` is who says it; `None`: nobody in
    /// particular. The game and its hashes do not change.
    pub fn note(
        &mut self,
        seat: Option<usize>,
        said: &[(&str, &str)],
        seconds: f64,
    ) -> Result<(), Error> {
        let texts: Vec<String> = said
            .iter()
            .map(|(key, text)| {
                let escaped = text.replace('\\', "\\\\").replace('"', "\\\"");
                format!("\"{key}\":\"{escaped}\"")
            })
            .collect();
        let line = format!("{{\"note\":{{{}}}}}", texts.join(","));

        // The library reads the texts, as it would those of a file.
        *self.scratch = self.of.record;
        self.scratch.note = Default::default();
        if !said.is_empty() {
            let at = line.as_ptr() as *const c_char;
            let status = unsafe { sys::carom_record_read(&mut *self.scratch, at, line.len()) };
            if status < 0 {
                let fault = text(self.scratch.fault.as_ptr());
                return Err(Error {
                    status: status_of(status),
                    fault,
                });
            }
        }
        self.scratch.note.seconds = seconds;
        let seat = seat.map_or(-1, |seat| seat.min(sys::CAROM_SEATS_MOST as usize) as i32);
        let status = unsafe { sys::carom_match_note(&mut *self.of, seat, &self.scratch.note) };
        self.told(status)
    }

    /// The lines of the notes of the recording so far, which it does not seal.
    pub fn notes(&self) -> impl Iterator<Item = &str> {
        self.lines
            .lines()
            .filter(|line| line.trim_start_matches([' ', '{']).starts_with("\"note\""))
    }

    /// Plays a choice of a plan: places, calls and plays its stroke, or passes. `cue` is the stroke
    /// as the player makes it. `prepare` and `stroke` can stop its shot.
    pub fn take(&mut self, best: &PlanStroke, cue: &Cue) -> Result<(), Error> {
        self.prepare(best)?;
        if best.kind != sys::CAROM_PLAN_PASS {
            self.stroke(cue, &Options::default())?;
        }
        Ok(())
    }

    /// The text of the last ruling.
    pub fn words(&self) -> String {
        words(&self.of.ruling)
    }

    pub(crate) fn at_table(&self) -> i32 {
        self.of.seat
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Game, RackKind, Status, TableKind};

    #[test]
    fn refuses_rules_and_reads_again() -> Result<(), Error> {
        fn can_move<T: Send + Sync>() {}
        can_move::<Match>();
        can_move::<crate::Position>();
        can_move::<crate::Thinking>();
        let table = crate::table(TableKind::Pool9ft)?;
        let mut game = Match::begin(RulesKind::Eightball, &table, 1, 0)?;
        let beyond = game.place(0.6, 1.0).unwrap_err();
        assert_eq!(beyond.status, Status::ErrorAct);
        assert!(beyond.fault.contains("0.635"), "{}", beyond.fault);
        game.place(0.6, 0.6)?;
        let cue = Cue {
            speed: 8.0,
            ..crate::cue(Game::Pool)
        };
        let of = game.position(&cue, 600.0);
        assert!(of.plan(1, false)?[0].place[1] <= table.length / 4.0);
        assert_eq!(of.leave, Leave::Kitchen);
        let stop = Options {
            time_most: 0.2,
            ..Options::default()
        };
        assert!(!game.stroke(&cue, &stop)?);
        assert_eq!(game.last().map(Shot::time), Some(0.2));
        assert!(game.go_on(&Options::default())?);
        assert!(game.last().map_or(0, |shot| shot.events().len()) > 20);
        let file = game.lines();
        let again = Match::load(file)?;
        assert_eq!(again.side(), game.side());
        assert_eq!(again.state().record.hash, game.state().record.hash);
        assert!(
            Match::load(&file.replace("\"foul\":", "\"foul\":1")).is_err()
                || !file.contains("foul")
        );
        for kind in [RulesKind::Straight, RulesKind::Onepocket, RulesKind::Bank] {
            let balls = crate::rack(RackKind::Eightball, &table, 1e-4, 1)?;
            let rules = crate::built_in_rules(kind);
            let mut of = Position::new(&table, &balls, &cue, &rules, 600.0);
            of.options.shots = 100;
            assert!(of.plan(1, true)?[0].place[1] <= table.length / 4.0);
        }

        // a ball in the jaws behind the head string, from where it may not be met
        let mut balls = crate::rack(RackKind::Eightball, &table, 1e-4, 1)?;
        balls[0].state.r[1] = 0.3;
        balls[1].state.r[..2].copy_from_slice(&[0.06, 0.06]);
        let rules = crate::built_in_rules(RulesKind::Straight);
        let mut of = Position::new(&table, &balls, &cue, &rules, 600.0);
        of.options.shots = 300;
        let free = of.plan(1, false)?[0];
        assert_eq!(free.ball, 1);
        of.leave = Leave::Kitchen;
        let best = of.plan(1, false)?[0];
        assert!(best.ball != 1 || best.kind != free.kind);
        Ok(())
    }
}
