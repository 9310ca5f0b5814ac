// As game.c, in C#.
using System;
using System.IO;
using System.Collections.Generic;
using Carom;

static class Program {
  static ulong Add(ulong hash, double number) {
    ulong bits = (ulong)BitConverter.DoubleToInt64Bits(number);
    for (int one = 0; one < 8; one++)
      hash = unchecked((hash ^ (bits >> 8 * one & 255)) * 0x100000001b3);
    return hash;
  }
  static ulong Add(ulong hash, DoubleArray3 numbers) {
    return Add(Add(Add(hash, numbers[0]), numbers[1]), numbers[2]);
  }

  static unsafe int Main(string[] arguments) {
    using (var recording = new Recording()) {
      foreach (var line in File.ReadLines(arguments[0]))
        if (!recording.Read(line)) {
          Console.Error.WriteLine($"shot {recording.Shots} has other bits than were recorded");
          return 1;
        }
      if (!recording.Ended)
        return 1;
      Console.WriteLine($"recording: {recording.Shots} shots, {recording.Hash:x16}");
      try {
        recording.Read("{}");
        return 1;
      } catch (CaromException wrong) {
        if (wrong.Status != Status.ErrorRecord || recording.Ended)
          throw;
      }
    }

    var table = Billiards.Table(TableKind.Pool9ft);
    var balls = Billiards.Rack(RackKind.Nineball, table);
    var cue = Billiards.Cue(Game.Pool);
    cue.speed = 8.0;
    var shot = Billiards.Play(table, balls, cue);
    ulong hash = 0xcbf29ce484222325;
    foreach (var one in shot.Events)
      hash = Add(hash, one.time);
    // States after the end are those at the end.
    foreach (var state in shot.At(shot.Time + 1))
      hash = Add(Add(Add(hash, state.r), state.v), state.w);
    Console.WriteLine($"break: {shot.Events.Length} events, {hash:x16}");

    // The film of the shot in parts.
    var film = new Film();
    var options = new ShotOptions { timeMost = 0.2 };
    var parts = Billiards.Play(table, balls, cue, options);
    int frames = 0;
    for (; frames / 60.0 < shot.Time; frames++) {
      options.timeMost = frames / 60.0 + 0.2;
      if (frames / 60.0 > parts.Time)
        parts.Resume(table, options);
      film.At(parts, frames / 60.0);
      for (int k = 0; k < film.States.Length; k++) {
        hash = Add(hash, film.States[k].r);
        for (int n = 0; n < 4; n++)
          hash = Add(hash, film.Turned[4 * k + n]);
      }
    }
    foreach (var happened in shot.Events)
      hash = Add(hash, shot.Slip(happened));
    Console.WriteLine($"film: {frames} frames, {hash:x16}");

    // The layout after the shot, and a ball in hand.
    Part part;
    var layout = (ShotBall[])balls.Clone();
    if (Billiards.Place(table, layout, 0, layout[3].state.r[0], layout[3].state.r[1], out part) ||
        part.kind != PartKind.Ball || part.index != 3)
      return 1;
    layout = shot.Layout();
    if (layout[5].state.r[1] != shot.Final[5].r[1])
      return 1;
    if (!Billiards.Place(table, layout, 0, 0.31, 0.3, out part) || layout[0].state.r[0] != 0.31)
      return 1;
    parts.Resume(table);
    Facts facts = shot.Facts, all = parts.Facts;
    if (all.down != facts.down || all.first[0] != 1 || all.firstTime[0] != facts.firstTime[0])
      return 1;
    if (facts.first[0] != 1 || shot.Drawn(table, 0.5).Length != 10)
      return 1;

    Plans(table);

    cue.speed = -1;
    try {
      Billiards.Play(table, balls, cue);
      return 1;
    } catch (CaromException wrong) {
      if (wrong.Message != "cue.speed must be 0 to 1000, in m/s, not -1")
        throw;
    }
    // Each number of a ball is refused by its name and range.
    cue.speed = 8;
    var rows = Billiards.Rows(PartKind.Ball);
    for (int k = 0; k < rows.Length; k++)
      try {
        var bad = (ShotBall[])balls.Clone();
        fixed(ShotBall *ball = bad)((double *)&ball[2].kind)[k] = double.NaN;
        Billiards.Play(table, bad, cue);
        return 1;
      } catch (CaromException wrong) {
        if (wrong.Message != $"ball[2].{rows[k].Name} must be {rows[k].Range}, not NaN")
          throw;
      }
    foreach (Words of in Enum.GetValues(typeof(Words)))
      if (Billiards.Word(of, 1) == null || Billiards.Word(of, 99) != null)
        return 1;
    if (sizeof(BallKind) != rows.Length * sizeof(double) ||
        Billiards.Word(Words.ShotCushion, (int)ShotCushion.Han) != "han")
      return 1;
    return 0;
  }

  /// A drill: any ball counts, until one misses.
  sealed class Drill : GameRules {
    protected override uint On(ulong[] user, uint inPlay) {
      return inPlay & ~1u;
    }
    protected override Turn Judge(ulong[] user, uint inPlay, int cueBall, Facts facts, Call call) {
      bool potted = facts.down != 0 && (facts.down & 1) == 0;
      user[0] += potted ? 1u : 0u;
      return new Turn { @is = potted ? TurnIs.Keep : TurnIs.Pass, points = potted ? 1 : 0 };
    }
    protected override int[] Left(ulong[] user, uint inPlay) {
      return inPlay > 3 ? new[] { 2, 2 } : new[] { 1, 1 };
    }
  }

  static void Must(bool good, string what) {
    if (!good)
      throw new Exception(what);
  }

  /// Plans in one call and in slices, an aimed pot, and a recording that is written.
  static void Plans(Table table) {
    Part part;
    var cue = Billiards.Cue(Game.Pool);
    var balls = Billiards.Rack(RackKind.Nineball, table);
    Array.Resize(ref balls, 3);
    var places = new[,] { { 0.6, 0.9 }, { 0.3, 0.4 }, { 0.9, 2.0 } };
    for (int k = 0; k < 3; k++)
      Must(Billiards.Place(table, balls, k, places[k, 0], places[k, 1], out part),
           "a place is not free");
    var drill = new Drill();
    foreach (var rules in new[] { Billiards.Rules(RulesKind.Potting), drill.Data() }) {
      var of = new Position(table, balls, cue, rules, 600);
      of.Rules.race = (int)Race.Alone;
      of.Options.shots = 300;
      var best = of.Plan(2);
      Must(best[0].keep > 0.5, "a near ball is missed");
      int slices = 1;
      using (var mind = of.Think(20, 2)) {
        for (; !mind.GoOn(); slices++)
          GC.Collect();
        Must(slices > 5 && mind.Choices.Length == best.Length &&
                 mind.Choices[0].cue.phi == best[0].cue.phi,
             "slices choose otherwise");
      }
      var told = of.Chances(new[] { best[0].cue, cue });
      Must(told[0].keep > told[1].keep && of.Value(true) >= of.Value() &&
               of.Plan(1, true).Length == 1,
           "chances");
      of.Options.shots = -1;
      try {
        of.Plan();
        Must(false, "a bad option passed");
      } catch (CaromException wrong) {
        Must(wrong.Status == Status.ErrorOptions, wrong.Message);
      }
    }
    GC.KeepAlive(drill);

    cue.speed = 2;
    var pot = new Pot { ball = 1, pocket = 0 };
    Billiards.Aim(table, balls, ref pot, ref cue);
    var whole = Billiards.Play(table, balls, cue);
    Must(pot.@is == (int)PotIs.Falls && whole.Facts.down == 2, "the aimed ball stays up");
    Must(Billiards.Strike(Native.carom_player_fargo(400), 1, 0, cue).phi != cue.phi,
         "a 400 does not err");

    var lines = "";
    using (var game = new Recording()) using (var read = new Recording()) {
      lines += game.Begin(table, balls) + game.Shoot(cue) + game.Hand(0) + game.Place(0, 0.5, 0.3) +
               game.Shoot(cue) + game.End();
      foreach (var line in lines.Split(new[] { '\n' }, StringSplitOptions.RemoveEmptyEntries))
        Must(read.Read(line), line);
      Must(read.Ended && read.Shots == 2 && read.Hash == game.Hash &&
               read.Layout()[2].state.r[1] == game.Layout()[2].state.r[1],
           "a recording differs");
      Must(read.Last.Events.Length > 2 && read.Last.Time == game.Last.Time &&
               read.Last.Final[0].r[1] == game.Last.Final[0].r[1],
           "a shot that was read differs");
      Must(read.Facts.moved == game.Facts.moved, "facts differ");
    }
  }
}
