//! `server PORT SECONDS`: nine-ball between the first two who connect. README.md has its lines.
use carom::{Match, MatchPhase, Options, RulesKind, TableKind};
use std::io::{ErrorKind, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::time::{Duration, Instant};

const CLIENTS_MOST: usize = 64;
const LINE_MOST: usize = 8192;

struct Client {
    stream: TcpStream,
    line: Vec<u8>, // what has come of it
}

/// Nobody waits for a client: one that does not read must leave.
fn send(to: &mut Option<Client>, text: &str) {
    let Some(client) = to else { return };
    let sent = client.stream.write(text.as_bytes());
    if !text.is_empty() && sent.unwrap_or(0) < text.len() {
        *to = None;
    }
}

/// Who connects gets the first free seat, and the recording so far.
fn let_in(clients: &mut [Option<Client>], stream: TcpStream, recording: &str) {
    let Some(seat) = clients.iter().position(Option::is_none) else {
        return;
    };
    if stream.set_nonblocking(true).is_err() {
        return;
    }
    let line = Vec::new();
    clients[seat] = Some(Client { stream, line });
    send(&mut clients[seat], &format!("{recording}seat {seat}\n"));
}

/// Judges the lines that have come from a client.
fn receive(from: &mut Option<Client>, seat: usize, game: &mut Match) {
    let Some(client) = from else { return };
    let mut bytes = [0; LINE_MOST];
    match client.stream.read(&mut bytes) {
        Err(none) if none.kind() == ErrorKind::WouldBlock => return,
        Err(_) | Ok(0) => return *from = None,
        Ok(got) => client.line.extend(&bytes[..got]),
    }
    let mut refusals = String::new();
    while let Some(end) = client.line.iter().position(|&byte| byte == b'\n') {
        let line: Vec<u8> = client.line.drain(..=end).collect();
        if let Err(refused) = game.receive(&String::from_utf8_lossy(&line), Some(seat)) {
            refusals += &format!("refused {}\n", refused.fault);
        }
    }
    if client.line.len() >= LINE_MOST {
        *from = None;
    }
    send(from, &refusals);
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let listener = TcpListener::bind(format!("0.0.0.0:{}", arguments[1]))?;
    listener.set_nonblocking(true)?;
    let limit = Duration::from_secs_f64(arguments[2].parse()?);
    let mut game = Match::begin(
        RulesKind::Nineball,
        &carom::table(TableKind::Pool9ft)?,
        5,
        0,
    )?;
    let mut clients: Vec<Option<Client>> = (0..CLIENTS_MOST).map(|_| None).collect();
    let (mut turn, mut due) = (-1, Instant::now());
    while !game.is_over() {
        std::thread::sleep(Duration::from_millis(10));
        if let Ok((stream, _)) = listener.accept() {
            let_in(&mut clients, stream, game.lines());
        }
        let known = game.lines().len();
        for (seat, client) in clients.iter_mut().enumerate() {
            receive(client, seat, &mut game);
        }
        if turn == game.state().rulings && Instant::now() >= due {
            match game.phase() {
                MatchPhase::Moving => game.go_on(&Options::default()).map(|_| ())?,
                _ => game.clock()?, // a foul
            }
        }
        if turn != game.state().rulings && (turn >= 0 || clients[1].is_some()) {
            turn = game.state().rulings;
            due = Instant::now() + limit;
        }
        if game.is_over() && !game.lines().contains("{\"end\"") {
            game.end()?;
        }
        for client in &mut clients {
            send(client, &game.lines()[known..]);
        }
    }
    std::thread::sleep(Duration::from_secs(1)); // in which all read the end
    Ok(())
}
