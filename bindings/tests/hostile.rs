//! `hostile ROWS MATCH`: the lines that hostile.c wrote, received by a match of Rust.
use carom::{Error, Match};

/// What a refused line may not change.
fn state_of(game: &Match) -> String {
    let (hash, phase) = (game.state().record.hash, game.phase());
    let (seat, actor) = (game.seat(), game.actor());
    format!("{}{hash} {phase:?} {seat} {actor:?}", game.lines())
}

fn judge(game: &mut Match, act: &[String], row: &str) -> Result<(), Error> {
    let mut parts = row.splitn(3, '|');
    let mut next = || parts.next().expect("NAME|SEAT|LINE");
    let (name, seat, text) = (next(), next(), next());
    let state = state_of(game);
    match game.receive(text, seat.parse().ok()) {
        Ok(is_new) => {
            let is_empty = text.trim().is_empty() || text.starts_with("{\"event\"");
            assert!(!is_new && is_empty, "{name} is accepted");
        }
        Err(refused) => assert!(!refused.fault.is_empty(), "{name} has no reason"),
    }
    assert_eq!(state_of(game), state, "{name} changed the match");

    // The honest act: its line, then those of its ruling, then all again.
    let mut twin = game.copy()?;
    assert!(twin.receive(&act[0], Some(0))?, "{name}: the honest line");
    let lines = format!("{}{}\n", game.lines(), act.join("\n"));
    assert_eq!(twin.lines(), lines, "{name}: the honest act");
    for line in act.iter().chain(act) {
        assert!(!twin.receive(line, Some(0))?, "{name}: a line is new");
    }
    assert_eq!(twin.lines(), lines, "{name}: a known line");
    assert_eq!(twin.actor(), Some(0));
    Ok(())
}

fn main() -> Result<(), Error> {
    let path = std::env::args().nth(1).expect("the rows of hostile.c");
    let file = std::fs::read_to_string(path).expect("the rows of hostile.c");
    let (mut begin, mut act, mut sent) = (String::new(), Vec::new(), 0);
    let mut game = None;
    for line in file.lines() {
        let (word, rest) = line.split_once(' ').expect("a word before each line");
        match word {
            "begin" => begin += &format!("{rest}\n"),
            "place" => {
                let mut begun = Match::load(&begin)?;
                assert_eq!(begun.actor(), None);
                assert!(begun.receive(rest, Some(0))?);
                game = Some(begun);
            }
            "act" => act.push(rest.to_string()),
            _ => {
                judge(game.as_mut().expect("a line place"), &act, rest)?;
                sent += 1;
            }
        }
    }

    // The whole match, to its end.
    let path = std::env::args().nth(2).expect("the match of hostile.c");
    let lines = std::fs::read_to_string(path).expect("the match of hostile.c");
    let mut game = game.expect("a line place");
    for line in lines[game.lines().len()..].lines() {
        game.receive(line, None)?;
    }
    assert_eq!(game.lines(), lines);
    println!("{sent} rows");
    Ok(())
}
