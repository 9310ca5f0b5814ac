// The game of match.c in C#: Match.exe FILE STROKES.
using System;
using System.IO;
using Carom;

static class Match {
  static void Main(string[] arguments) {
    string file = arguments[0], lines = File.Exists(file) ? File.ReadAllText(file) : "";
    var cue = Billiards.Cue(Game.Pool);
    using (var game =
               lines == ""
                   ? LiveMatch.Begin(RulesKind.Eightball, Billiards.Table(TableKind.Pool9ft), 5)
                   : LiveMatch.Load(lines.Substring(0, lines.LastIndexOf('\n') + 1))) {
      for (int k = int.Parse(arguments[1]); k > 0 && !game.Over; k--) {
        int me = game.Seat;
        var position = game.Position(cue, me == 0 ? 550 : 650);
        position.Opponent = game.Position(cue, me == 0 ? 650 : 550).Player;
        position.Options.shots = 300;
        var best = position.Plan()[0];
        game.Take(best, Billiards.Strike(position.Player, 9, (ulong)game.Shots, best.cue));
        Console.WriteLine($"{me + 1}: {game.Words}");
        if (game.Over)
          game.End();
      }
      File.WriteAllText(file, game.Lines);
    }
  }
}
