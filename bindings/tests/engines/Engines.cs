// What the examples of Unity and Godot ask of their engines, as far as Mono shows it, and scenes
// that play: frames pass until a stroke has been played, and balls lie on the cloth.
using System;
using System.Collections.Generic;

namespace UnityEngine {
  public struct Vector3 {
    public float x, y, z;
    public Vector3(float x, float y, float z) {
      this.x = x;
      this.y = y;
      this.z = z;
    }
  }
  public struct Quaternion {
    public float x, y, z, w;
    public Quaternion(float x, float y, float z, float w) {
      this.x = x;
      this.y = y;
      this.z = z;
      this.w = w;
    }
  }
  public class Transform {
    public Vector3 position, forward;
    public Quaternion rotation;
  }
  public class MonoBehaviour {}
  public class AudioClip {}
  public class AudioSource {
    public AudioClip clip;
    public static int Played;
    public void PlayOneShot(AudioClip of, float volume) {
      Played++;
    }
  }
  public class Camera {
    public static Camera main = new Camera();
    public Transform transform = new Transform { forward = new Vector3(0, 0, 1) };
  }
  public enum KeyCode { Space }
  public static class Input {
    public static bool GetKeyDown(KeyCode key) {
      return true;
    }
  }
  public static class Time { public const float deltaTime = 1 / 60f; }
  public static class Mathf {
    public const float Rad2Deg = 57.29578f;
    public static float Atan2(float y, float x) {
      return (float)Math.Atan2(y, x);
    }
  }
  public static class Debug {
    public static void Log(string text) {
      Console.WriteLine(text);
    }
  }
}

namespace Godot {
  public struct Vector3 {
    public float X, Y, Z;
    public Vector3(float x, float y, float z) {
      X = x;
      Y = y;
      Z = z;
    }
  }
  public struct Quaternion {
    public float X, Y, Z, W;
    public Quaternion(float x, float y, float z, float w) {
      X = x;
      Y = y;
      Z = z;
      W = w;
    }
  }
  public class ExportAttribute : Attribute {}
  public class SignalAttribute : Attribute {}
  public class Node {
    public readonly List<Node> Children = new List<Node>();
    public Action<string, string> Heard;
    public T GetChild<T>(int k)
        where T : Node {
      return (T)Children[k];
    }
    public void EmitSignal(string name, string text) {
      Heard(name, text);
    }
    public virtual void _Ready() {
    }
    public virtual void _ExitTree() {
    }
    public virtual void _Process(double delta) {
    }
  }
  public class Node3D : Node {
    public Vector3 Position;
    public Quaternion Quaternion;
  }
}

// Godot's generator makes the names of signals.
public partial class GodotTable {
  public static class SignalName { public const string Sent = "sent", Cheated = "cheated"; }
}

static class Engines {
  static void Call(object of, string method) {
    of.GetType()
        .GetMethod(method, System.Reflection.BindingFlags.Instance |
                               System.Reflection.BindingFlags.NonPublic)
        .Invoke(of, null);
  }

  static void Unity() {
    var table = new UnityTable { balls = new UnityEngine.Transform[16],
                                 click = new UnityEngine.AudioSource() };
    for (int k = 0; k < 16; k++)
      table.balls[k] = new UnityEngine.Transform();
    Call(table, "Start");
    var head = table.balls[1].position;
    for (int frame = 0; frame < 3000; frame++)
      Call(table, "Update");
    Call(table, "OnDestroy");
    bool moved = table.balls[1].position.x != head.x, lies = table.balls[1].position.y < 0.03;
    Console.WriteLine(
        $"Unity: ball 1 has moved: {moved}, is not above the cloth: {lies}, sounds: " +
        (UnityEngine.AudioSource.Played > 20));
  }

  static void Godot() {
    var clients = new GodotTable[4];
    int cheats = 0;
    for (int seat = 0; seat < 4; seat++) {
      int sender = seat;
      clients[seat] = new GodotTable { Seat = seat };
      for (int k = 0; k < 10; k++)
        clients[seat].Children.Add(new global::Godot.Node3D());
      clients[seat].Heard = (name, text) => {
        if (name == "cheated" && cheats++ == 0)
          Console.WriteLine($"Godot: {text}");
        for (int to = 0; name == "sent" && to < 4; to++)
          if (to != sender)
            clients[to].Receive(text, sender);
      };
      clients[seat]._Ready();
    }
    clients[3].Shoot(1.57); // it is not its turn: nothing is sent
    foreach (var client in clients)
      client.Shoot(1.57);
    // seat 1 concedes for seat 0
    var hidden = System.Reflection.BindingFlags.Instance | System.Reflection.BindingFlags.NonPublic;
    var match = (Carom.LiveMatch) typeof(GodotTable).GetField("match", hidden).GetValue(clients[0]);
    using (var forged = match.Copy()) {
      forged.Concede(0);
      clients[2].Receive(forged.Lines.Substring(match.Lines.Length).Split('\n')[0], 1);
    }
    bool same = true;
    foreach (var client in clients) {
      for (int frame = 0; frame < 600; frame++)
        client._Process(1 / 60.0);
      for (int k = 0; k < 10; k++) {
        var own = client.GetChild<global::Godot.Node3D>(k).Position;
        var first = clients[0].GetChild<global::Godot.Node3D>(k).Position;
        same &= own.X == first.X && own.Z == first.Z;
      }
      client._ExitTree();
    }
    Console.WriteLine($"Godot: four clients show the same balls: {same}, cheats: {cheats}");
  }

  static void Main() {
    Unity();
    Godot();
  }
}
