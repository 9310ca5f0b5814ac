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

/// A ruling of a file that is read only in part: no line is lost, whatever comes next.
fn read_in_part(
    mut partial: Match,
    game: &Match,
    act: &[String],
    said: &str,
    following: &str,
) -> Result<(), Error> {
    let whole = format!("{}{}\n", game.lines(), act.join("\n"));
    assert_eq!(partial.lines(), whole);
    let mut noted = partial.copy()?;
    noted.read(said)?;
    let (first, ruling) = (&act[0], act[1..].join("\n"));
    assert_eq!(
        noted.lines(),
        format!("{}{first}\n{said}{ruling}\n", game.lines())
    );
    let refused = partial.place(9.0, 9.0).unwrap_err();
    assert!(!refused.fault.is_empty());
    assert_eq!(partial.lines(), whole);
    for mut judged in [partial.copy()?, noted] {
        let before = judged.lines().to_string();
        assert!(!judged.receive(&act[1], Some(0))?);
        assert!(judged.receive(following, None)?);
        assert!(judged
            .lines()
            .starts_with(&format!("{before}{following}\n")));
    }
    let mut spoken = partial.copy()?;
    spoken.note(Some(1), &[("comment", "between")], 0.0)?;
    assert!(spoken.lines().starts_with(&format!("{whole}{{\"note\"")));
    for line in &act[1..] {
        partial.read(line)?;
    }
    assert_eq!(partial.lines(), whole);
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

    // A note, and some that are refused.
    let begun = game.as_ref().expect("a line place");
    let mut talk = begun.copy()?;
    let words = [
        ("comment", "He said \"nice\""),
        ("offer", "draw"),
        ("x_club", "A \\ B"),
    ];
    talk.note(Some(1), &words, 12.5)?;
    let said = talk.notes().next().expect("a note").to_string() + "\n";
    let with_note = begun.lines().to_string() + &said;
    for wrong in [
        ("comment", "two\nlines"),
        ("offer", "money"),
        ("chat", "hello"),
    ] {
        let refused = talk.note(Some(0), &[wrong], 0.0).unwrap_err();
        assert!(!refused.fault.is_empty(), "{wrong:?} has no reason");
        assert_eq!(talk.lines(), with_note);
    }
    assert!(talk.note(Some(0), &[], 0.0).is_err());
    assert!(talk.receive(&act[0], Some(0))?);
    assert_eq!(talk.lines(), with_note + &act.join("\n") + "\n");
    print!("{said}");

    let path = std::env::args().nth(2).expect("the match of hostile.c");
    let lines = std::fs::read_to_string(path).expect("the match of hostile.c");
    let mut game = game.expect("a line place");
    let whole = format!("{}{}\n", game.lines(), act.join("\n"));
    assert!(act.len() > 1 && lines.starts_with(&whole));
    let following = lines[whole.len()..].lines().next().expect("a line behind");
    let mut read = game.copy()?;
    read.read(&act[0])?;
    let loaded = Match::load(&format!("{}{}", game.lines(), act[0]))?;
    for partial in [read, loaded] {
        read_in_part(partial, &game, &act, &said, following)?;
    }

    // The whole match, to its end.
    for line in lines[game.lines().len()..].lines() {
        game.receive(line, None)?;
    }
    assert_eq!(game.lines(), lines);
    println!("{sent} rows");
    Ok(())
}
