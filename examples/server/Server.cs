// Server.exe PORT SECONDS: nine-ball between the first two who connect, with SECONDS for a stroke.
// Others look on. README.md has the lines that it sends.
using System;
using System.Net;
using System.Net.Sockets;
using System.Text;
using System.Threading;
using Carom;

static class Server {
  const int ClientsMost = 64, LineMost = 8192;
  static readonly LiveMatch match =
      LiveMatch.Begin(RulesKind.Nineball, Billiards.Table(TableKind.Pool9ft), 5);
  static readonly Client[] clients = new Client[ClientsMost]; // by seat

  sealed class Client {
    public Socket Socket;
    public byte[] Line = new byte[LineMost]; // what has come of it
    public int Size;
  }

  /// Nobody waits for a client: one that does not read must leave.
  static void Send(int seat, string text) {
    if (clients[seat] == null)
      return;
    var bytes = Encoding.UTF8.GetBytes(text);
    int sent = clients[seat].Socket.Send(bytes, 0, bytes.Length, SocketFlags.None, out _);
    if (sent < bytes.Length)
      Leave(seat);
  }
  static void Leave(int seat) {
    clients[seat]?.Socket.Close();
    clients[seat] = null;
  }

  /// Who connects gets the first free seat, and the recording so far.
  static void LetIn(Socket socket) {
    int seat = Array.IndexOf(clients, null);
    if (seat < 0) {
      socket.Close();
      return;
    }
    socket.Blocking = false;
    clients[seat] = new Client { Socket = socket };
    Send(seat, $"{match.Lines}seat {seat}\n");
  }

  /// Judges the lines that have come from a client.
  static void Receive(int seat) {
    var from = clients[seat];
    if (from == null || !from.Socket.Poll(0, SelectMode.SelectRead))
      return;
    int got =
        from.Socket.Receive(from.Line, from.Size, LineMost - from.Size, SocketFlags.None, out _);
    from.Size += got;
    for (int end; (end = Array.IndexOf(from.Line, (byte)'\n', 0, from.Size)) >= 0;) {
      try {
        match.Receive(Encoding.UTF8.GetString(from.Line, 0, end), seat);
      } catch (CaromException refused) {
        Send(seat, $"refused {refused.Message}\n");
      }
      from.Size -= end + 1;
      Array.Copy(from.Line, end + 1, from.Line, 0, from.Size);
    }
    if (got == 0 || from.Size == LineMost)
      Leave(seat);
  }

  static void Main(string[] arguments) {
    var listener = new TcpListener(IPAddress.Any, int.Parse(arguments[0]));
    listener.Start();
    long turn = -1;
    for (var due = DateTime.UtcNow; !match.Over; Thread.Sleep(10)) {
      if (listener.Pending())
        LetIn(listener.AcceptSocket());
      int known = match.Lines.Length;
      for (int seat = 0; seat < ClientsMost; seat++)
        Receive(seat);
      if (turn == match.State.rulings && DateTime.UtcNow >= due) {
        if (match.Phase == MatchPhase.Moving)
          match.GoOn();
        else
          match.Clock(); // a foul
      }
      if (turn != match.State.rulings && (turn >= 0 || clients[1] != null)) {
        turn = match.State.rulings;
        due = DateTime.UtcNow.AddSeconds(double.Parse(arguments[1]));
      }
      if (match.Over && !match.Lines.Contains("{\"end\""))
        match.End();
      for (int seat = 0; seat < ClientsMost; seat++)
        Send(seat, match.Lines.Substring(known));
    }
    Thread.Sleep(1000); // in which all read the end
  }
}
