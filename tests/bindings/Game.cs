// As game.c, in C#.
using System;
using System.IO;
using Carom;

static class Program {
  static ulong Add(ulong hash, double number) {
    ulong bits = (ulong)BitConverter.DoubleToInt64Bits(number);
    for (int one = 0; one < 8; one++) hash = unchecked((hash ^ (bits >> 8 * one & 255)) * 0x100000001b3);
    return hash;
  }
  static ulong Add(ulong hash, DoubleArray3 numbers) { return Add(Add(Add(hash, numbers[0]), numbers[1]), numbers[2]); }

  static unsafe int Main(string[] arguments) {
    using (var recording = new Recording()) {
      foreach (var line in File.ReadLines(arguments[0]))
        if (!recording.Read(line)) {
          Console.Error.WriteLine($"shot {recording.Shots} has other bits than were recorded");
          return 1;
        }
      if (!recording.Ended) return 1;
      Console.WriteLine($"recording: {recording.Shots} shots, {recording.Hash:x16}");
      try {
        recording.Read("{}");
        return 1;
      } catch (CaromException wrong) {
        if (wrong.Status != Status.ErrorRecord || recording.Ended) throw;
      }
    }

    var table = Billiards.Table(TableKind.Pool9ft);
    var balls = Billiards.Rack(RackKind.Nineball, table);
    var cue = Billiards.Cue(Game.Pool);
    cue.speed = 8.0;
    var shot = Billiards.Play(table, balls, cue);
    ulong hash = 0xcbf29ce484222325;
    foreach (var one in shot.Events) hash = Add(hash, one.time);
    // States after the end are those at the end.
    foreach (var state in shot.At(shot.Time + 1)) hash = Add(Add(Add(hash, state.r), state.v), state.w);
    Console.WriteLine($"break: {shot.Events.Length} events, {hash:x16}");

    var film = new Film();
    int frames = 0;
    for (; frames / 60.0 < shot.Time; frames++) {
      film.At(shot, frames / 60.0);
      for (int k = 0; k < film.States.Length; k++) {
        hash = Add(hash, film.States[k].r);
        for (int n = 0; n < 4; n++) hash = Add(hash, film.Turned[4 * k + n]);
      }
    }
    Console.WriteLine($"film: {frames} frames, {hash:x16}");

    // The layout after the shot, and a ball in hand.
    Part part;
    var layout = (ShotBall[])balls.Clone();
    if (Billiards.Place(table, layout, 0, layout[3].state.r[0], layout[3].state.r[1], out part) || part.kind != PartKind.Ball || part.index != 3) return 1;
    layout = shot.Layout();
    if (layout[5].state.r[1] != shot.Final[5].r[1]) return 1;
    if (!Billiards.Place(table, layout, 0, 0.31, 0.3, out part) || layout[0].state.r[0] != 0.31) return 1;
    var facts = shot.Facts;
    if (facts.first[0] != 1 || shot.Drawn(table, 0.5).Length != 10) return 1;

    cue.speed = -1;
    try {
      Billiards.Play(table, balls, cue);
      return 1;
    } catch (CaromException wrong) {
      if (wrong.Message != "cue.speed must be 0 to 1000, in m/s, not -1") throw;
    }
    // Each number of a ball is refused by its name and range.
    cue.speed = 8;
    var rows = Billiards.Rows(PartKind.Ball);
    for (int k = 0; k < rows.Length; k++)
      try {
        var bad = (ShotBall[])balls.Clone();
        fixed (ShotBall* ball = bad) ((double*)&ball[2].kind)[k] = double.NaN;
        Billiards.Play(table, bad, cue);
        return 1;
      } catch (CaromException wrong) {
        if (wrong.Message != $"ball[2].{rows[k].Name} must be {rows[k].Range}, not NaN") throw;
      }
    foreach (Words of in Enum.GetValues(typeof(Words)))
      if (Billiards.Word(of, 1) == null || Billiards.Word(of, 99) != null) return 1;
    if (sizeof(BallKind) != rows.Length * sizeof(double) || Billiards.Word(Words.ShotCushion, (int)ShotCushion.Han) != "han") return 1;
    return 0;
  }
}
