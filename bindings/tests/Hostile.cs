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

    // The whole match, to its end.
    string lines = File.ReadAllText(arguments[1]);
    foreach (var line in lines.Substring(game.Lines.Length).Split('\n'))
      game.Receive(line, null);
    Must(game.Lines == lines, "the whole match is another one");
    Console.WriteLine($"{sent} rows");
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
