// random_matches ACTS RULED: the acts that random_matches.c wrote, judged in Rust.
use carom::{Choice, Cue, Error, Game, Match, Options};

fn act(game: &mut Match, name: &str, x: &[f64]) -> Result<(), Error> {
    match name {
        "choose" => game.choose(Choice::try_from(1 << x[0] as i32).expect("a choice")),
        "place" => game.place(x[0], x[1]),
        "call" => game.call(x[0] as i32, x[1] as i32),
        "clock" => game.clock(),
        "extend" => game.extend(),
        "timeout" => game.timeout(),
        "next" => game.next(),
        "undo" => game.undo().map(|_| ()),
        "redo" => game.redo().map(|_| ()),
        "again" => game.copy().map(|copy| *game = copy),
        "concede" => game.concede(x[0] as usize),
        _ => {
            let cue = Cue {
                ball: x[0] as i64,
                speed: x[1],
                phi: x[2],
                theta: x[3],
                a: x[4],
                b: x[5],
                ..carom::cue(Game::Pool)
            };
            game.stroke(&cue, &Options::default()).map(|_| ())
        }
    }
}

/// What came of an act.
fn outcome(game: &mut Match, line: &str) -> String {
    let mut words = line.split(' ');
    let name = words.next().expect("an act");
    let numbers: Vec<f64> = words.map(|word| word.parse().expect("a number")).collect();
    if let Err(refused) = act(game, name, &numbers) {
        return refused.fault;
    }
    let again = match (name, game.last()) {
        ("again", last) => format!("{} events\n", last.map_or(0, |shot| shot.events().len())),
        _ => String::new(),
    };
    let (of, words) = (game.state(), game.words());
    let words = if of.rulings > 0 { words } else { String::new() };
    format!(
        "{again}taken: phase {}, seat {}, winner {}, may {}, ball {}, on {}, touching {}: {words}",
        of.phase,
        game.seat(),
        of.winner - 1,
        of.may,
        of.cue_ball,
        of.on,
        of.touching,
    )
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let (mut begin, mut ruled, mut game) = (String::new(), String::new(), None);
    for line in std::fs::read_to_string(&arguments[1])?.lines() {
        if line == "match" {
            (begin, game) = (String::new(), None);
        } else if line.starts_with('{') {
            begin += &format!("{line}\n");
        } else {
            if game.is_none() {
                let begun = Match::load(&begin)?;
                ruled += begun.lines();
                game = Some(begun);
            }
            let of = game.as_mut().expect("a match that has begun");
            let known = of.lines().len();
            let outcome = outcome(of, line);
            ruled += &format!("{}{outcome}\n", &of.lines()[known.min(of.lines().len())..]);
        }
    }
    Ok(std::fs::write(&arguments[2], ruled)?)
}
