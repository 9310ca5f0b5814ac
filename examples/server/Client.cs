// Client.exe HOST PORT: plays a seat of a server by plans, or looks on, and prints the match.
using System;
using System.IO;
using System.Net.Sockets;
using Carom;

static class Client {
  /// The lines of the best stroke of the seat at the table, and of what comes before it.
  static string Act(LiveMatch match) {
    using (var mine = match.Copy()) {
      var position = mine.Position(mine.Cue, 600);
      position.Options.shots = 100;
      var best = position.Plan()[0];
      mine.Take(best, best.cue);
      return mine.Lines.Substring(match.Lines.Length);
    }
  }

  static int Main(string[] arguments) {
    var socket = new TcpClient(arguments[0], int.Parse(arguments[1]));
    var reader = new StreamReader(socket.GetStream());
    var writer = new StreamWriter(socket.GetStream()) { AutoFlush = true };
    LiveMatch match = null;
    string begin = "", awaited = ""; // the last line that was sent, until it comes back
    int seat = -1;
    for (string line; (line = reader.ReadLine()) != null;) {
      if (line.StartsWith("refused ")) {
        Console.Error.WriteLine(line); // such as an act that came after its time
        awaited = "";
        continue;
      }
      if (line.StartsWith("seat ")) {
        seat = int.Parse(line.Substring(5));
        match = LiveMatch.Load(begin);
      } else if (match == null)
        begin += line + "\n";
      else
        match.Receive(line, null);
      if (line == awaited)
        awaited = "";
      if (line.StartsWith("{\"end\"")) {
        Console.Write(match.Lines);
        return 0;
      }
      bool isMine = match != null && match.Seat == seat && awaited == "" && !match.Over;
      if (isMine && match.Phase != MatchPhase.Moving) {
        var lines = Act(match);
        awaited = lines.Substring(lines.LastIndexOf('\n', lines.Length - 2) + 1).TrimEnd();
        writer.Write(lines);
      }
    }
    return 1; // the server has left before the end
  }
}
