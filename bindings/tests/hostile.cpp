// hostile ROWS MATCH: the lines that hostile.c wrote, received by a match of carom.hpp.
#include <carom.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

/* What a refused line may not change. */
static std::string state_of(const carom::match &game) {
  const carom_match &of = game.state();
  return game.lines() + std::to_string(of.record.hash) + " " + std::to_string(of.phase) + " " +
         std::to_string(of.seat);
}

static void must(bool good, const std::string &what) {
  if (good)
    return;
  std::fprintf(stderr, "%s\n", what.c_str());
  std::exit(1);
}

int main(int, char **arguments) {
  std::ifstream rows(arguments[1]);
  carom::match game;
  std::vector<std::string> act;
  std::string honest;
  int sent = 0;
  for (std::string line; std::getline(rows, line);) {
    const std::size_t blank = line.find(' ');
    const std::string word = line.substr(0, blank), rest = line.substr(blank + 1);
    if (word == "begin" || word == "place") {
      game.receive(rest, word == "begin" ? -1 : 0);
      continue;
    }
    if (word == "act") {
      act.push_back(rest);
      honest += rest + "\n";
      continue;
    }
    const std::size_t bar = rest.find('|'), next = rest.find('|', bar + 1);
    const std::string name = rest.substr(0, bar), text = rest.substr(next + 1);
    const int seat = std::stoi(rest.substr(bar + 1));
    const bool is_empty =
        text.find_first_not_of(' ') == std::string::npos || text.rfind("{\"event\"", 0) == 0;
    const std::string state = state_of(game);
    std::string why;
    try {
      game.receive(text, seat);
    } catch (const carom::error &refused) {
      why = refused.what();
    }
    must(!why.empty() || is_empty, name + " is accepted, or has no reason");
    must(state_of(game) == state, name + " changed the match");

    /* the honest act: its line, then those of its ruling, then all again */
    carom::match twin = game.copy();
    twin.receive(act[0], 0);
    const std::string lines = game.lines() + honest;
    must(twin.lines() == lines, name + ": the honest act has other lines behind it");
    for (int times = 0; times < 2; times++)
      for (const std::string &one : act)
        twin.receive(one, 0);
    must(twin.lines() == lines && twin.actor() == 0, name + ": a known line changed the match");
    sent++;
  }

  /* the whole match, to its end */
  std::ifstream file(arguments[2]);
  const std::string lines(std::istreambuf_iterator<char>(file), {});
  while (game.lines().size() < lines.size()) {
    const std::size_t begin = game.lines().size();
    game.receive(lines.substr(begin, lines.find('\n', begin) + 1 - begin), -1);
  }
  must(game.lines() == lines, "the whole match is another one");
  std::printf("%d rows\n", sent);
  return 0;
}
