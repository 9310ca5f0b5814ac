//! `client HOST PORT`: plays a seat of a server by plans, or looks on, and prints the match.
use carom::{Error, Match, MatchPhase};
use std::io::{BufRead, BufReader, Write};
use std::net::TcpStream;

/// The lines of the best stroke of the seat at the table, and of what comes before it.
fn act(game: &Match) -> Result<String, Error> {
    let mut mine = game.copy()?;
    let mut position = mine.position(&mine.cue(), 600.0);
    position.options.shots = 100;
    let best = position.plan(1, false)?[0];
    mine.take(&best, &best.cue)?;
    Ok(mine.lines()[game.lines().len()..].to_string())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let mut server = TcpStream::connect(format!("{}:{}", arguments[1], arguments[2]))?;
    let (mut begin, mut awaited) = (String::new(), String::new());
    let mut seated: Option<(Match, usize)> = None;
    for line in BufReader::new(server.try_clone()?).lines() {
        let line = line?;
        if line.starts_with("refused ") {
            eprintln!("{line}"); // such as an act that came after its time
            awaited.clear();
            continue;
        }
        if let Some(seat) = line.strip_prefix("seat ") {
            seated = Some((Match::load(&begin)?, seat.parse()?));
        } else if let Some((game, _)) = &mut seated {
            game.receive(&line, None)?;
        } else {
            begin += &format!("{line}\n");
        }
        if line == awaited {
            awaited.clear();
        }
        let Some((game, seat)) = &seated else {
            continue;
        };
        if line.starts_with("{\"end\"") {
            print!("{}", game.lines());
            return Ok(());
        }
        let waits = matches!(game.phase(), MatchPhase::Stroke | MatchPhase::Place);
        if waits && game.seat() == *seat && awaited.is_empty() {
            let lines = act(game)?;
            awaited = lines.lines().last().unwrap_or_default().to_string();
            server.write_all(lines.as_bytes())?;
        }
    }
    Err("the server has left before the end".into())
}
