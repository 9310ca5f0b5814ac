/*
 * The game of game.c in C++20: eight-ball between two programs, sent as a recording, and judged by
 * its reader.  One side plays and writes lines of a recording; the other reads them, plays every
 * shot again and compares its bits. The rules and both
 * players are those of carom_plan.h. With exceptions or without them, it prints the same. */
#include <carom.hpp>

#include <cinttypes>
#include <cstdio>
#include <string>

namespace {

constexpr int most_shots = 150;

class game {
public:
  game() {
    const carom_table table = carom::table(CAROM_TABLE_POOL_9FT);
    sent_ = record_.begin(table, carom::rack(CAROM_RACK_EIGHTBALL, table, 1e-4, 7));
    rules_ = carom_plan_rules_of(CAROM_RULES_EIGHTBALL);
    rules_.state.opening = 1; // before the break
  }

  bool over() const {
    return winner_ >= 0;
  }
  int winner() const {
    return winner_;
  }
  std::int64_t shots() const {
    return record_.game().shots;
  }

  // The best stroke that a plan finds, with the errors of the player, and what it comes to by the
  // rules.
  bool play() {
    carom_record &of = record_.game();
    const carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    carom_plan_options wanted{};
    wanted.shots = 300;
    wanted.seed = static_cast<uint64_t>(of.shots);
    wanted.opponent = &players_[1 - player_];
    carom_plan_job job = carom::job(of.table, record_.layout(), cue, players_[player_], rules_);
    job.shot = &of.options;
    job.options = &wanted;
    const auto best = carom::plan(job, 1, of.hand == 1);
    if (best.empty())
      return false;
    if (of.hand == 1) {
      if (record_.place(0, best[0].place[0], best[0].place[1]) != CAROM_OK)
        return false;
      sent_ += record_.write(CAROM_RECORD_PLACE);
    }
    of.cue = best[0].cue;
    carom_player_strike(&players_[player_], 1, wanted.seed, &of.cue);
    if (record_.play() != CAROM_OK)
      return false;
    sent_ += record_.write(CAROM_RECORD_SHOT);
    judge({best[0].ball, best[0].pocket});
    return true;
  }

  std::string end() {
    return sent_ += record_.write(CAROM_RECORD_END);
  }

private:
  void judge(carom_call call) {
    const carom_ruling ruling = carom::referee(rules_, record_.last(), call);
    rules_.state = ruling.state;
    sent_ += carom::settle(record_, ruling);
    if (ruling.winner >= 0)
      winner_ = ruling.winner == 0 ? player_ : 1 - player_;
    else if (ruling.next == 1)
      player_ = 1 - player_;
  }

  carom::recording record_;
  carom_plan_rules rules_{};
  carom_player players_[2] = {carom_player_fargo(500.0), carom_player_fargo(600.0)};
  int player_ = 0, winner_ = -1;
  std::string sent_;
};

// How many shots have the bits that were recorded, up to the first that has not; -1 where a line is
// wrong or missing.
std::int64_t referee(std::string_view lines) {
  carom::recording record;
  const carom_record &of = record.game();
  while (!lines.empty()) {
    const auto size = lines.find('\n') + 1;
    if (record.read(lines.substr(0, size)) < 0)
      return -1;
    lines.remove_prefix(size);
    if (of.kind != CAROM_RECORD_SHOT)
      continue;
    record.play();
    if (!record.same())
      return of.shots - 1;
  }
  return of.kind == CAROM_RECORD_END ? of.shots : -1;
}

} // namespace

int main() {
  game played;
  while (!played.over() && played.shots() < most_shots)
    if (!played.play())
      return 1;
  const std::string sent = played.end();
  const std::int64_t good = referee(sent);
  std::printf("player %d wins after %" PRId64 " shots; the referee accepts %" PRId64 "\n",
              played.winner() + 1, played.shots(), good);
  return played.over() && good == played.shots() ? 0 : 1;
}
