// The game of match.cpp in C#: Match.exe FILE keeps its recording, and goes on with one that was
// saved.
using System;
using System.Globalization;
using System.IO;
using Carom;

static class Match {
  static int Main(string[] arguments) {
    CultureInfo.DefaultThreadCurrentCulture = CultureInfo.CurrentCulture =
        CultureInfo.InvariantCulture;
    var table = Billiards.Table(TableKind.Pool9ft);
    var cue = Billiards.Cue(Game.Pool);
    var rules = Billiards.Rules(RulesKind.Nineball);
    var film = new Film();
    int player = 0, winner = -1, frames = 0;
    double loudest = 0; // N s
    using (var game = new Recording()) using (var read = new Recording()) {
      string file = arguments[0], lines = File.Exists(file) ? File.ReadAllText(file) : "";
      if (!game.Load(lines))
        throw new Exception("a shot has other bits than were recorded");
      if (lines == "") {
        lines = game.Begin(table, Billiards.Rack(RackKind.Nineball, table, 1e-4, 2));
        rules.state.opening = 1; // before the break
        lines += game.Stand(RulesKind.Nineball, rules.state, 0);
      }
      while (winner < 0) {
        // the game is kept; the player thinks, while the shot of the other is drawn
        File.WriteAllText(file, lines);
        rules.state = game.Standing;
        player = game.AtTable;
        var position = new Position(table, game.Layout(), cue, rules, player == 0 ? 500 : 600);
        position.Options.shots = 300;
        Choice best;
        using (var mind = position.Think(500, 1, game.InHand)) {
          for (int frame = 0; !mind.Ended; frame++, frames++) {
            mind.GoOn();
            if (game.Last != null)
              film.At(game.Last, frame / 60.0);
          }
          best = mind.Choices[0];
        }

        // the stroke, and how it sounds
        if (game.InHand)
          lines += game.Place(0, best.place[0], best.place[1]);
        lines += game.Shoot(Billiards.Strike(position.Player, 1, (ulong)game.Shots, best.cue));
        foreach (var happened in game.Last.Events)
          loudest = Math.Max(loudest, happened.impulse);

        // the ruling, and the layout that it leaves
        var ruling = Billiards.Referee(rules, game.Last,
                                       new Call { ball = best.ball, pocket = best.pocket });
        Console.WriteLine($"{player + 1}: {Billiards.Words(ref ruling)}");
        lines += game.Settle(ref ruling);
        winner = ruling.winner < 0 ? -1 : player ^ ruling.winner;
        player ^= ruling.next;
        if (winner < 0)
          lines += game.Stand(RulesKind.Nineball, ruling.state, player);
      }
      lines += game.End();
      File.WriteAllText(file, lines);
      Console.WriteLine(
          $"player {winner + 1} wins; {frames} frames, the hardest blow {loudest:F4} N s");

      // a reader plays every shot again, and compares its bits
      return read.Load(lines) && read.Ended ? 0 : 1;
    }
  }
}
