// Names.exe: a misspelt name is quoted and corrected, and synonyms of the library's table count.
using System;
using Carom;

static class NamesTest {
  static void Must(bool good, string what) {
    if (!good)
      throw new Exception(what);
  }

  /// A name with its last two letters exchanged, or with one letter more.
  static string Misspelt(string name) {
    int last = name.Length - 1;
    string turned = name.Substring(0, last - 1) + name[last] + name[last - 1];
    return turned != name ? turned : name + "x";
  }

  static string Refusal<T>(string name)
      where T : struct {
    try {
      Names.Value<T>(name);
    } catch (CaromException refused) {
      return refused.Message;
    }
    return "";
  }

  static void EveryName<T>()
      where T : struct {
    var known = Names.Of<T>();
    Must(known.Count > 1, $"{typeof(T).Name} has no names");
    foreach (var name in known) {
      var value = Names.Value<T>(name);
      Must(Names.Value<T>(name.Replace('_', '-').ToUpperInvariant()).Equals(value), name);
      string wrong = Misspelt(name), fault = Refusal<T>(wrong);
      Must(fault.StartsWith($"unknown name \"{wrong}\"; did you mean \"{name}\"?",
                            StringComparison.Ordinal),
           fault);
    }
  }

  static void Main() {
    EveryName<TableKind>();
    EveryName<RackKind>();
    EveryName<RulesKind>();
    EveryName<ShotCushion>();
    EveryName<Condition>();
    EveryName<ShotEventType>();
    EveryName<Choice>();
    foreach (var name in new[] { "9-ball", "9ball", "Nine-ball", "nineball" })
      Must(Names.Value<RulesKind>(name) == RulesKind.Nineball, name);
    Must(Names.Value<TableKind>("9-foot") == TableKind.Pool9ft, "9-foot");
    Must(Refusal<TableKind>("billiards room").Contains("; use one of "), "a suggestion");
    Must(Refusal<TableKind>(null) != "" && Refusal<TableKind>("") != "", "no name");
  }
}
