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

/* A ruling of a file that is read only in part: no line is lost, whatever comes next. */
static void read_in_part(carom::match &&partial, const carom::match &game,
                         const std::vector<std::string> &act, const std::string &said,
                         const std::string &lines) {
  std::string ruling;
  for (std::size_t k = 1; k < act.size(); k++)
    ruling += act[k] + "\n";
  const std::string whole = game.lines() + act[0] + "\n" + ruling;
  must(!ruling.empty() && lines.rfind(whole, 0) == 0, "no ruling");
  const std::string following =
      lines.substr(whole.size(), lines.find('\n', whole.size()) + 1 - whole.size());
  must(partial.lines() == whole, "the lines of the ruling are missing");
  carom::match noted = partial.copy();
  noted.read(said);
  must(noted.lines() == game.lines() + act[0] + "\n" + said + ruling, "a note before the ruling");
  std::string why;
  try {
    partial.place(9, 9);
  } catch (const carom::error &refused) {
    why = refused.what();
  }
  must(!why.empty() && partial.lines() == whole, "a place off the table");
  carom::match twin = partial.copy();
  for (carom::match *judged : {&twin, &noted}) {
    const std::string before = judged->lines();
    judged->receive(act[1], 0);
    must(judged->lines() == before, "a line of the ruling is new");
    judged->receive(following, -1);
    must(judged->lines().rfind(before + following, 0) == 0,
         "an act behind a part of a ruling loses lines");
  }
  carom::match spoken = partial.copy();
  spoken.note(1, {{"comment", "between"}});
  must(spoken.lines().rfind(whole + "{\"note\"", 0) == 0,
       "a note behind a part of a ruling loses lines");
  for (std::size_t k = 1; k < act.size(); k++)
    partial.read(act[k]);
  must(partial.lines() == whole, "the rest of the ruling");
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

  /* a note, and some that are refused */
  carom::match talk = game.copy();
  talk.note(1, {{"comment", "He said \"nice\""}, {"offer", "draw"}, {"x_club", "A \\ B"}}, 12.5);
  const std::string said = talk.lines().substr(game.lines().size());
  const std::pair<std::string_view, std::string_view> wrong[] = {
      {"comment", "two\nlines"}, {"offer", "money"}, {"chat", "hello"}, {"comment", ""}};
  for (const auto &one : wrong) {
    std::string why;
    try {
      talk.note(0, {one});
    } catch (const carom::error &refused) {
      why = refused.what();
    }
    must(!why.empty() && talk.lines() == game.lines() + said,
         std::string(one.first) + ": the note is not refused");
  }
  talk.receive(act[0], 0);
  must(talk.lines() == game.lines() + said + honest, "the act behind a note has other lines");
  std::printf("%s", said.c_str());

  std::ifstream file(arguments[2]);
  const std::string lines(std::istreambuf_iterator<char>(file), {});
  carom::match read = game.copy(), loaded;
  read.read(act[0]);
  loaded.load(game.lines() + act[0]);
  read_in_part(std::move(read), game, act, said, lines);
  read_in_part(std::move(loaded), game, act, said, lines);

  /* the whole match, to its end */
  while (game.lines().size() < lines.size()) {
    const std::size_t begin = game.lines().size();
    game.receive(lines.substr(begin, lines.find('\n', begin) + 1 - begin), -1);
  }
  must(game.lines() == lines, "the whole match is another one");
  std::printf("%d rows\n", sent);
  return 0;
}
