/* A match of nine-ball between programs that exchange the lines of a recording by a local socket.
 *
 *     match host PORT FILE [SHOTS]  breaks, and keeps the game in FILE; goes on with one that it has
 *     match join PORT               plays against the host
 *     match watch PORT              comes later: plays the shots so far again, follows the rest
 *
 * Strokes and places travel, and nothing else. Each program plays every shot itself, compares its
 * bits with the recorded ones, and judges it by the same rules. With SHOTS the host leaves after so
 * many. match.mjs joins and watches in JavaScript. */
#include "peer.hpp"

#include <carom.hpp>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <fstream>

namespace {

/* The game, which lines make, whoever wrote them. */
struct match {
  carom::recording record;
  carom_record &of = record.game();
  carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  carom_player rating[2] = {carom_player_fargo(500.0), carom_player_fargo(600.0)};
  std::string lines;     /* so far */
  int player = 0;        /* at the table */
  std::uint32_t put = 0; /* balls that may be put elsewhere: the cue ball in hand, spotted ones */
  carom::shot shown;     /* the last one, for the film */
  int frames = 0;

  match() {
    rules.state.opening = 1; /* before the break */
  }
  void begin() {
    const carom_table table = carom::table(CAROM_TABLE_POOL_9FT);
    lines = record.begin(table, carom::rack(CAROM_RACK_NINEBALL, table, 1e-4, 2));
  }
  bool ended() const {
    return of.kind == CAROM_RECORD_END;
  }
  bool is_turn_of(int who) const {
    return !ended() && player == who && put < 2; /* spotted balls come before */
  }

  void write(carom_record_kind kind) {
    lines += record.write(kind);
  }
  /* A line of the other: his shot is played, and he puts balls where the rules allow it. */
  void read(const std::string &line) {
    lines += line;
    record.read(line);
    if (of.kind == CAROM_RECORD_SHOT) {
      record.play();
      if (!record.same())
        throw std::runtime_error("shot " + std::to_string(of.shots) +
                                 " has other bits than were recorded");
      judge();
    } else if (of.kind == CAROM_RECORD_PLACE) {
      if ((put >> of.placed & 1) == 0)
        throw std::runtime_error("ball " + std::to_string(of.placed) + " is not in hand");
      put &= ~(UINT32_C(1) << of.placed);
    }
  }

  /* What the last shot amounts to. Returns whether it ends the game. */
  bool judge() {
    std::uint32_t in_play = 0;
    for (int k = 0; k < of.count; k++)
      in_play |= std::uint32_t{of.balls[k].state.label < CAROM_BALL_POCKETED} << k;
    const carom_turn turn = rules.judge(&rules.state, in_play, 0, &of.facts, {-1, -1});
    rules.state.may = 0; /* without push-outs */
    put = turn.spot | std::uint32_t{turn.leave != CAROM_LEAVE_AFTER};
    if (turn.is == CAROM_TURN_PASS || turn.is == CAROM_TURN_LOSE)
      player = 1 - player; /* who is at the table at the end has won */
    shown.play(of.table, {of.balls, static_cast<std::size_t>(of.count)}, of.cue);
    return turn.is == CAROM_TURN_WIN || turn.is == CAROM_TURN_LOSE;
  }

  /* The stroke of the player at the table, who thinks in slices, each beside a frame of the film. */
  template <class Frame> void stroke(Frame frame) {
    const carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    carom_plan_options wanted{};
    wanted.shots = 300;
    carom_plan_job job = carom::job(of.table, record.layout(), cue, rating[player], rules);
    job.options = &wanted;
    carom::film film;
    carom::thinking mind(job, 500, 1, put == 1);
    for (; !mind.ended(); frames++) {
      mind.go_on();
      if (of.shots > 0)
        film.at(shown, frames / 60.0);
      frame();
    }
    const carom_choice best = mind.choices()[0];
    if (put == 1) {
      record.place(0, best.place[0], best.place[1]);
      write(CAROM_RECORD_PLACE);
    }
    of.cue = best.cue;
    carom_player_strike(&rating[player], 1, static_cast<std::uint64_t>(of.shots), &of.cue);
    record.play();
    write(CAROM_RECORD_SHOT);
    const bool last = judge();

    /* balls that come back, on the long string */
    for (int k = 1; k < of.count; k++)
      if (put >> k & 1) {
        record.spot(k);
        write(CAROM_RECORD_PLACE);
      }
    put &= 1;
    if (last)
      write(CAROM_RECORD_END);
  }
};

void host(match &game, int port, const char *path, std::int64_t most) {
  std::ifstream before(path);
  for (std::string line; std::getline(before, line);)
    game.read(line + "\n");
  std::size_t kept = game.lines.size();
  std::ofstream file(path, std::ios::app | std::ios::binary);
  if (game.lines.empty())
    game.begin();
  std::vector<peer> peers;
  const int door = local(port, true);
  std::printf("port %d\n", port);
  std::fflush(stdout);

  /* Lets others in, with all lines so far, then an empty one; tells all what is new. */
  const auto attend = [&](int milliseconds) {
    for (pollfd at = {door, POLLIN, 0}; ::poll(&at, 1, milliseconds) > 0; milliseconds = 0) {
      peer one{::accept(door, nullptr, nullptr)};
      one.plays = one.line() == "join\n";
      one.update(game.lines);
      one.tell("\n");
      peers.push_back(one);
    }
    for (peer &one : peers)
      one.update(game.lines);
    file << game.lines.substr(kept) << std::flush;
    kept = game.lines.size();
  };
  while (!game.ended() && game.of.shots < most) {
    const auto player =
        std::find_if(peers.begin(), peers.end(), [](const peer &p) { return p.plays; });
    if (game.is_turn_of(0)) {
      game.stroke([&] { attend(0); });
    } else if (player == peers.end()) {
      attend(100);
    } else if (const std::string line = player->line(); !line.empty()) {
      player->sent += line.size();
      game.read(line);
    } else {
      peers.erase(player); /* he has left; another may take his place */
    }
    attend(0);
  }
  for (const peer &one : peers)
    ::close(one.socket);
}

void visit(match &game, int port, const std::string &role) {
  peer other{local(port, false)};
  other.tell(role + "\n");
  std::string line;
  for (bool current = false; !game.ended();) {
    if (current && role == "join" && game.is_turn_of(1)) {
      other.sent = game.lines.size();
      game.stroke([] {});
      other.update(game.lines);
    } else if ((line = other.line()).empty()) {
      return;
    } else {
      current |= line == "\n"; /* that was all so far */
      if (line != "\n")
        game.read(line);
    }
  }
}

} // namespace

int main(int argc, char **argv) try {
  const std::string role = argc > 1 ? argv[1] : "";
  match game;
  if (role == "host" && argc > 3)
    host(game, std::atoi(argv[2]), argv[3], argc > 4 ? std::atoi(argv[4]) : 1000);
  else if ((role == "join" || role == "watch") && argc == 3)
    visit(game, std::atoi(argv[2]), role);
  else
    throw std::runtime_error("host PORT FILE [SHOTS], join PORT or watch PORT");
  std::printf("%d frames\n%s after %" PRId64 " shots, %016" PRIx64 "\n", game.frames,
              game.ended() ? game.player == 0 ? "the host wins" : "the guest wins"
                           : "not at its end",
              game.of.shots, game.of.hash);
  return 0;
} catch (const std::exception &wrong) {
  std::fprintf(stderr, "match: %s\n", wrong.what());
  return 1;
}
