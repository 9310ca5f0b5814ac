// RandomMatches.exe ACTS RULED: the acts that random_matches.c wrote, judged in C#.
using System;
using System.IO;
using System.Linq;
using Carom;

static class RandomMatches {
  static void Act(LiveMatch game, string name, double[] x) {
    switch (name) {
    case "choose":
      game.Choose((Choice)(1 << (int)x[0]));
      break;
    case "place":
      game.Place(x[0], x[1]);
      break;
    case "call":
      game.Call((int)x[0], (int)x[1]);
      break;
    case "clock":
      game.Clock();
      break;
    case "extend":
      game.Extend();
      break;
    case "timeout":
      game.Timeout();
      break;
    case "next":
      game.Next();
      break;
    case "undo":
      game.Undo();
      break;
    case "redo":
      game.Redo();
      break;
    case "concede":
      game.Concede((int)x[0]);
      break;
    case "again":
      break;
    default:
      var cue = Billiards.Cue(Game.Pool);
      cue.ball = (long)x[0];
      cue.speed = x[1];
      cue.phi = x[2];
      cue.theta = x[3];
      cue.a = x[4];
      cue.b = x[5];
      game.Stroke(cue);
      break;
    }
  }

  /// What came of an act.
  static string Outcome(LiveMatch game, string[] words) {
    try {
      Act(game, words[0], words.Skip(1).Select(double.Parse).ToArray());
    } catch (CaromException refused) {
      return refused.Message.Replace(Calls.StatusString(refused.Status) + ": ", "");
    }
    var state = game.State;
    var again = words[0] == "again" ? $"{game.Last?.Events.Length ?? 0} events\n" : "";
    return again + $"taken: phase {state.phase}, seat {game.Seat}, winner {state.winner - 1}, " +
           $"may {state.may}, ball {state.cueBall}, on {state.on}, touching {state.touching}: " +
           (state.rulings > 0 ? game.Words : "");
  }

  static void Main(string[] arguments) {
    LiveMatch game = null;
    string begin = "";
    int known = 0;
    using (var ruled = new StreamWriter(arguments[1])) {
      foreach (var line in File.ReadLines(arguments[0])) {
        if (line == "match") {
          game?.Dispose();
          game = null;
          begin = "";
        } else if (line.StartsWith("{")) {
          begin += line + "\n";
        } else {
          if (game == null)
            ruled.Write((game = LiveMatch.Load(begin)).Lines);
          known = game.Lines.Length;
          if (line == "again") {
            var copy = game.Copy();
            game.Dispose();
            game = copy;
          }
          var outcome = Outcome(game, line.Split(' '));
          known = Math.Min(known, game.Lines.Length);
          ruled.Write(game.Lines.Substring(known) + outcome + "\n");
        }
      }
    }
  }
}
