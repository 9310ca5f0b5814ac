// random_matches ACTS RULED: the acts that random_matches.c wrote, judged by carom.hpp.
#include <carom.hpp>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

static void act(carom::match &game, std::istringstream &words) {
  std::string name;
  words >> name;
  double x[6] = {};
  for (double &number : x)
    words >> number;
  if (name == "choose")
    game.choose(static_cast<carom_choice>(1 << static_cast<int>(x[0])));
  else if (name == "place")
    game.place(x[0], x[1]);
  else if (name == "call")
    game.call(static_cast<int>(x[0]), static_cast<int>(x[1]));
  else if (name == "clock")
    game.clock();
  else if (name == "extend")
    game.extend();
  else if (name == "timeout")
    game.timeout();
  else if (name == "next")
    game.next();
  else if (name == "undo")
    game.undo();
  else if (name == "redo")
    game.redo();
  else if (name == "again")
    game = game.copy();
  else if (name == "concede")
    game.concede(static_cast<int>(x[0]));
  else {
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.ball = static_cast<std::int64_t>(x[0]);
    cue.speed = x[1];
    cue.phi = x[2];
    cue.theta = x[3];
    cue.a = x[4];
    cue.b = x[5];
    game.stroke(cue);
  }
}

/* What came of an act. */
static std::string outcome(carom::match &game, const std::string &line) {
  std::istringstream words(line);
  std::ostringstream text;
  try {
    act(game, words);
    if (line == "again")
      text << game.last().events().size() << " events\n";
  } catch (const carom::error &) {
    return game.state().fault;
  }
  const carom_match &of = game.state();
  text << "taken: phase " << of.phase << ", seat " << game.seat() << ", winner " << of.winner - 1
       << ", may " << of.may << ", ball " << of.cue_ball << ", on " << of.on << ", touching "
       << of.touching << ": " << (of.rulings > 0 ? game.words() : "");
  return text.str();
}

int main(int, char **arguments) {
  std::ifstream acts(arguments[1]);
  std::ofstream ruled(arguments[2]);
  std::optional<carom::match> game;
  std::string begin;
  for (std::string line; std::getline(acts, line);) {
    if (line == "match") {
      game.reset();
      begin.clear();
    } else if (line[0] == '{') {
      begin += line + "\n";
    } else {
      if (!game) {
        game.emplace();
        game->load(begin);
        ruled << game->lines();
      }
      const std::size_t known = game->lines().size();
      const std::string text = outcome(*game, line);
      ruled << game->lines().substr(std::min(known, game->lines().size())) << text << "\n";
    }
  }
  return 0;
}
