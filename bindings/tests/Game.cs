// As game.c, in C#.
using System;
using System.IO;
using System.Linq;
using System.Reflection;
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
    Callbacks(table, shot);
    Matches(table);
    Names();
    Disposed(table);

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
      return new Turn { outcome = potted ? TurnOutcome.Keep : TurnOutcome.Pass,
                        points = potted ? 1 : 0 };
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
    Must(pot.outcome == (int)PotOutcome.Falls && whole.Facts.down == 2, "the aimed ball stays up");
    Must(Billiards.Strike(Calls.PlayerFargo(400), 1, 0, cue).phi != cue.phi, "a 400 does not err");

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
    using (var game = new Recording()) {
      game.Begin(table, balls, new ShotOptions { timeMost = 0.2 });
      game.Shoot(cue);
      try {
        game.Shoot(cue);
        Must(false, "a stroke while balls move");
      } catch (CaromException wrong) {
        Must(wrong.Message.Contains("balls move"), wrong.Message);
      }
    }
  }

  /// Rules with every callback, which are all asked, and each of which may throw.
  sealed class Every : GameRules {
    public string Throws = "";
    public readonly System.Collections.Generic.HashSet<string> Asked =
        new System.Collections.Generic.HashSet<string>();

    void Ask(string what) {
      lock (Asked) Asked.Add(what);
      if (what == Throws)
        throw new InvalidOperationException(what);
    }
    protected override uint On(ulong[] user, uint inPlay) {
      Ask("On");
      return inPlay & ~1u;
    }
    protected override Turn Judge(ulong[] user, uint inPlay, int cueBall, Facts facts, Call call) {
      Ask("Judge");
      return new Turn { outcome = TurnOutcome.Pass, spot = facts.down & ~1u };
    }
    protected override int[] Left(ulong[] user, uint inPlay) {
      Ask("Left");
      return new[] { 2, 2 };
    }
    protected override uint Pockets(ulong[] user) {
      Ask("Pockets");
      return 63;
    }
    protected override double Value(ulong[] user, BallState[] layout, bool inHand) {
      Ask("Value");
      return layout.Length == 3 ? 0.25 : 0.0;
    }
    protected override double Points(ulong[] user, uint inPlay, int ball) {
      Ask("Points");
      return 1;
    }
    protected override void Settle(ulong[] user, Table table, ShotBall[] balls, ref Turn turn) {
      Ask("Settle");
      user[0] = 7;
      for (int k = 0; k < balls.Length; k++)
        if ((turn.spot >> k & 1) != 0)
          Billiards.Spot(RackKind.Nineball, table, balls, k);
    }
  }

  static void Callbacks(Table table, PlayedShot shot) {
    Part part;
    var balls = Billiards.Rack(RackKind.Nineball, table);
    Array.Resize(ref balls, 3);
    for (int k = 0; k < 3; k++)
      Billiards.Place(table, balls, k, 0.3 + 0.25 * k, 0.5 + 0.4 * k, out part);
    var rules = new Every();
    var of = new Position(table, balls, Billiards.Cue(Game.Pool), rules.Data(), 600);
    of.Rules.race = (int)Race.Points;
    of.Options.shots = 100;
    Must(of.Value() == 0.25, "a value of the rules'");
    of.Rules.value = IntPtr.Zero; // the library's, which asks for points
    of.Plan();
    var ruling = Billiards.Referee(of.Rules, shot);
    Must(ruling.state.user[0] == 7 && ruling.put == (shot.Facts.down & ~1u), "a layout");
    Must(rules.Asked.Count == 7, string.Join(" ", rules.Asked));
    foreach (var what in rules.Asked.ToArray()) {
      rules.Throws = what;
      int thrown = 0;
      foreach (var call in new Action[] { () => of.Plan(), () => of.Value(),
                                          () => Billiards.Referee(of.Rules, shot) })
        try {
          of.Rules.value = what == "Value" ? rules.Data().value : IntPtr.Zero;
          call();
        } catch (InvalidOperationException wrong) {
          Must(wrong.Message == what, wrong.Message);
          thrown++;
        }
      Must(thrown > 0, $"{what} threw in no call");
    }
    rules.Throws = "";
    of.Plan(); // what was thrown once is over
    Must(new Drill().Data().value == IntPtr.Zero, "what is not overridden is the library's own");
  }

  /// A match, planned and broken within its bounds, in parts, and read again.
  static void Matches(Table table) {
    using (var game = LiveMatch.Begin(RulesKind.Eightball, table, 1)) {
      var of = game.Position(Billiards.Cue(Game.Pool), 600);
      of.Options.shots = 100;
      var best = of.Plan()[0];
      Must(best.place[1] <= table.length / 4, "a break from beyond the head string");
      try {
        game.Place(0.6, 1.0);
        Must(false, "a place beyond the head string");
      } catch (CaromException wrong) {
        Must(wrong.Status == Status.ErrorAct && wrong.Message.Contains("0.635"), wrong.Message);
      }
      game.Place(best.place[0], best.place[1]);
      Must(game.Position(of.Cue, 600).Leave == Leave.Kitchen, "where the cue ball was placed");
      bool ended = game.Stroke(best.cue, new ShotOptions { timeMost = 0.2 });
      Must(!ended && game.Last.Time == 0.2, "a shot that is stopped");
      Must(game.GoOn() && game.Last.Events.Length > 20 && game.Words != "", "a shot that goes on");
      using (var read = LiveMatch.Load(game.Lines))
          Must(read.State.record.hash == game.State.record.hash && read.Side == game.Side,
               "a match that is read");
    }
    foreach (var kind in new[] { RulesKind.Straight, RulesKind.Onepocket, RulesKind.Bank }) {
      var of = new Position(table, Billiards.Rack(RackKind.Eightball, table),
                            Billiards.Cue(Game.Pool), Billiards.Rules(kind), 600);
      of.Options.shots = 100;
      Must(of.Plan(1, true)[0].place[1] <= table.length / 4, $"{kind} from beyond the head string");
    }
  }

  /// No type has the name of one of the namespaces that games import too.
  static void Names() {
    var unity =
        ("Animation Avatar Behaviour Bounds Cache Camera Canvas Cloth Collider Collision Color " +
         "Component Compass Cursor Debug Display Event EventType Flare Font Gradient Graphics " +
         "Grid Input Joint Keyframe Light Logger Material Mesh Motion Object Physics Ping Plane " +
         "Pose Projector Quaternion Random Ray Rect Resolution Screen Shader Skybox Social " +
         "Space Sprite Terrain Texture Time Touch Transform Tree Types")
            .Split(' ');
    var system = new[] { typeof(object), typeof(Uri), typeof(Enumerable) }
                     .SelectMany(one => one.Assembly.GetExportedTypes())
                     .Where(one => one.Namespace == "System")
                     .Select(one => one.Name);
    foreach (var type in typeof(Table).Assembly.GetExportedTypes())
      Must(!unity.Concat(system).Contains(type.Name),
           $"Carom.{type.Name} is a name of System or UnityEngine");
  }

  /// After Dispose() every member either throws ObjectDisposedException or has what it had.
  static void Disposed(Table table) {
    var position = new Position(table, Billiards.Rack(RackKind.Nineball, table),
                                Billiards.Cue(Game.Pool), Billiards.Rules(RulesKind.Nineball), 600);
    foreach (var of in new IDisposable[] { new Recording(), position.Think(0),
                                           LiveMatch.Begin(RulesKind.Nineball, table, 1) }) {
      of.Dispose();
      int refused = 0;
      foreach (var method in of.GetType().GetMethods(BindingFlags.Instance | BindingFlags.Public |
                                                     BindingFlags.DeclaredOnly))
        try {
          method.Invoke(of, method.GetParameters().Select(Any).ToArray());
        } catch (TargetInvocationException wrong) {
          Must(wrong.InnerException is ObjectDisposedException,
               $"{method}: {wrong.InnerException.Message}");
          refused++;
        }
      Must(refused > 0, $"{of} is not disposed");
    }
  }
  static object Any(ParameterInfo of) {
    var type = of.ParameterType.IsByRef ? of.ParameterType.GetElementType() : of.ParameterType;
    if (type == typeof(string))
      return "{}";
    return type.IsArray ? Array.CreateInstance(type.GetElementType(), 1)
                        : Activator.CreateInstance(type);
  }
}
