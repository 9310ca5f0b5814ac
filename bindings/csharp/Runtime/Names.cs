// Names of values as people write them, which the library has with their synonyms.
using System;
using System.Collections.Generic;
using System.Text;

namespace Carom {
  /// <summary>Names of the values of an enumeration: "9-ball" is RulesKind.Nineball.</summary>
  public static unsafe partial class Names {
    /// More values than any enumeration has, with gaps; then come the flags of Choice.
    const int ValuesMost = 64, FlagMost = 1 << 16;

    /// <summary>The names of an enumeration, in the order of its values.</summary>
    public static List<string> Of<T>()
        where T : struct {
      var kind = KindOf<T>();
      var names = new List<string>();
      for (int value = 0; value <= FlagMost; value = value < ValuesMost ? value + 1 : 2 * value) {
        var name = Calls.Word(kind, value);
        if (name != null)
          names.Add(name);
      }
      return names;
    }

    /// <summary>The value that a name stands for. Capitals, hyphens and underscores do not matter,
    /// and synonyms count. The exception for an unknown name quotes it, and suggests the name that
    /// was probably meant.</summary>
    public static T Value<T>(string name)
        where T : struct {
      var kind = KindOf<T>();
      int value;
      fixed(byte *text = Encoding.UTF8.GetBytes((name ?? "") + "\0")) value =
          Native.carom_word_value(kind, text);
      if (value >= 0)
        return (T)Enum.ToObject(typeof(T), value);
      var known = Of<T>();
      var meant = Suggestion(name ?? "", known);
      var hint = meant == null ? "; use" : $"; did you mean \"{meant}\"? Use";
      throw new CaromException($"unknown name \"{name}\"{hint} one of {string.Join(", ", known)}",
                               Status.ErrorOptions);
    }

    static Words KindOf<T>() {
      Words kind;
      if (Kinds.TryGetValue(typeof(T), out kind))
        return kind;
      throw new ArgumentException($"the values of {typeof(T).Name} have no names");
    }

    /// The name that a misspelt one resembles: at most a third of its letters differ.
    static string Suggestion(string text, List<string> known) {
      var letters = Letters(text);
      string found = null;
      int least = Math.Min(letters.Length, Math.Max(1, letters.Length / 3) + 1);
      foreach (var name in known) {
        int apart = Distance(letters, Letters(name));
        if (apart < least) {
          least = apart;
          found = name;
        }
      }
      return found;
    }

    static string Letters(string word) {
      var letters = new StringBuilder();
      foreach (var letter in word.ToLowerInvariant())
        if (char.IsLetterOrDigit(letter))
          letters.Append(letter);
      return letters.ToString();
    }

    /// How many letters must be inserted, deleted, replaced, or exchanged with the next one to turn
    /// one word into the other.
    static int Distance(string a, string b) {
      var rows = new int[a.Length + 1, b.Length + 1];
      for (int i = 0; i <= a.Length; i++)
        for (int k = 0; k <= b.Length; k++) {
          if (i == 0 || k == 0) {
            rows[i, k] = i + k;
            continue;
          }
          int replaced = rows[i - 1, k - 1] + (a[i - 1] == b[k - 1] ? 0 : 1);
          rows[i, k] = Math.Min(replaced, Math.Min(rows[i, k - 1], rows[i - 1, k]) + 1);
          if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
            rows[i, k] = Math.Min(rows[i, k], rows[i - 2, k - 2] + 1);
        }
      return rows[a.Length, b.Length];
    }
  }
}
