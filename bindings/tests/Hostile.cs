// Hostile.exe ROWS MATCH: the lines that hostile.c wrote, received by a match of C#.
using System;
using System.Collections.Generic;
using System.IO;
using Carom;

static class Hostile {
  static void Must(bool good, string what) {
    if (!good)
      throw new Exception(what);
  }
  /// What a refused line may not change.
  static string StateOf(LiveMatch game) {
    return $"{game.Lines}{game.State.record.hash} {game.Phase} {game.Seat} {game.Actor}";
  }

  static void Main(string[] arguments) {
    string begin = "";
    var act = new List<string>();
    LiveMatch game = null;
    int sent = 0;
    foreach (var line in File.ReadAllText(arguments[0]).TrimEnd('\n').Split('\n')) {
      string word = line.Substring(0, line.IndexOf(' ')), rest = line.Substring(word.Length + 1);
      if (word == "begin")
        begin += rest + "\n";
      else if (word == "place") {
        game = LiveMatch.Load(begin);
        Must(game.Actor == -1 && game.Receive(rest, 0), "the place is refused");
      } else if (word == "act")
        act.Add(rest);
      else {
        Judge(game, act, rest.Split(new[] { '|' }, 3));
        sent++;
      }
    }

    // A note, and some that are refused.
    var talk = game.Copy();
    talk.Note(1,
              new Dictionary<string, string> { { "comment", "He said \"nice\"" },
                                               { "offer", "draw" },
                                               { "x_club", "A \\ B" } },
              12.5);
    string said = talk.Notes[0] + "\n";
    foreach (var wrong in new[] { "comment two\nlines", "offer money", "chat hello", "comment " }) {
      var parts = wrong.Split(new[] { ' ' }, 2);
      string why = "";
      try {
        talk.Note(0, new Dictionary<string, string> { { parts[0], parts[1] } });
      } catch (CaromException refused) {
        why = refused.Message;
      }
      Must(why != "" && talk.Lines == game.Lines + said, $"{wrong} is not refused");
    }
    Must(talk.Receive(act[0], 0), "the act behind a note is refused");
    Must(talk.Lines == game.Lines + said + string.Join("\n", act) + "\n",
         "the act behind a note has other lines");
    Console.Write(said);

    string lines = File.ReadAllText(arguments[1]);
    var read = game.Copy();
    read.Read(act[0]);
    foreach (var partial in new[] { read, LiveMatch.Load(game.Lines + act[0]) })
      ReadInPart(partial, game, act, said, lines);

    // The whole match, to its end.
    foreach (var line in lines.Substring(game.Lines.Length).Split('\n'))
      game.Receive(line, null);
    Must(game.Lines == lines, "the whole match is another one");
    Console.WriteLine($"{sent} rows");
  }

  /// A ruling of a file that is read only in part: no line is lost, whatever comes next.
  static void ReadInPart(LiveMatch partial, LiveMatch game, List<string> act, string said,
                         string lines) {
    string whole = game.Lines + string.Join("\n", act) + "\n";
    string ruling = whole.Substring((game.Lines + act[0] + "\n").Length);
    Must(ruling != "" && lines.StartsWith(whole, StringComparison.Ordinal), "no ruling");
    string following = lines.Substring(whole.Length).Split('\n')[0];
    Must(partial.Lines == whole, "the lines of the ruling are missing");
    var noted = partial.Copy();
    noted.Read(said);
    Must(noted.Lines == $"{game.Lines}{act[0]}\n{said}{ruling}", "a note before the ruling");
    string why = "";
    try {
      partial.Place(9, 9);
    } catch (CaromException refused) {
      why = refused.Message;
    }
    Must(why != "" && partial.Lines == whole, "a place off the table");
    foreach (var judged in new[] { partial.Copy(), noted }) {
      string before = judged.Lines;
      Must(!judged.Receive(act[1], 0), "a line of the ruling is new");
      Must(judged.Receive(following, null), "the act behind is known");
      Must(judged.Lines.StartsWith($"{before}{following}\n", StringComparison.Ordinal),
           "an act behind a part of a ruling loses lines");
    }
    var spoken = partial.Copy();
    spoken.Note(1, new Dictionary<string, string> { { "comment", "between" } });
    Must(spoken.Lines.StartsWith(whole + "{\"note\"", StringComparison.Ordinal),
         "a note behind a part of a ruling loses lines");
    foreach (var line in act.GetRange(1, act.Count - 1))
      partial.Read(line);
    Must(partial.Lines == whole, "the rest of the ruling");
  }

  static void Judge(LiveMatch game, List<string> act, string[] row) {
    string name = row[0], text = row[2], state = StateOf(game);
    try {
      Must(!game.Receive(text, int.Parse(row[1])), $"{name} is accepted");
      Must(text.Trim() == "" || text.StartsWith("{\"event\""), $"{name} is not refused");
    } catch (CaromException refused) {
      Must(refused.Message != "", $"{name} has no reason");
    }
    Must(StateOf(game) == state, $"{name} changed the match");

    // The honest act: its line, then those of its ruling, then all again.
    using (var twin = game.Copy()) {
      Must(twin.Receive(act[0], 0), $"{name}: the honest line is not accepted behind it");
      string lines = game.Lines + string.Join("\n", act) + "\n";
      Must(twin.Lines == lines, $"{name}: the honest act has other lines behind it");
      for (int times = 0; times < 2; times++)
        foreach (var one in act)
          Must(!twin.Receive(one, 0), $"{name}: a line is new");
      Must(twin.Lines == lines && twin.Actor == 0, $"{name}: a known line changed the match");
    }
  }
}
