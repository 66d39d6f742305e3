// SPDX-License-Identifier: MIT
// PhysVib from C#: one file over libphysvib by P/Invoke, for Mono, .NET, Unity and Godot. Units, threads and errors: physvib.h.
using System;
using System.Runtime.InteropServices;

namespace PhysVib {

/// <summary>What an event came of: bodies that met, or a grain of what rolled or slid.</summary>
public enum Kind { Hit, Roll, Slide }

/// <summary>A collision as it is felt; see physvib_event.</summary>
public partial struct Event {
    /// <summary>One impact at time 0; strength: 0 to 1 of full scale. Of a built-in material, or else of 200 Hz.</summary>
    public static Event Impact(double x_m, double y_m, double strength, string material = null) {
        var made = new Event().Sized();
        Native.Check(Native.physvib_event_of(Native.Utf8OrNull(material), x_m, y_m, strength, ref made));
        return made;
    }
    /// <summary>The same; it says its size.</summary>
    internal Event Sized() {
        size = Native.SizeOf(this);
        return this;
    }
    /// <summary>The same events; each says its size, as a list has to.</summary>
    internal static Event[] Sized(Event[] events) {
        for (var i = 0; events != null && i < events.Length; ++i) events[i] = events[i].Sized();
        return events;
    }
    /// <summary>The number that events of a sound of that name have.</summary>
    public static int SoundOf(string name) { return (int)Native.Check(Native.physvib_sound(Native.Utf8(name))); }
    /// <summary>The number of the part of a body of that name ("thumb"), for Part here and in layouts.</summary>
    public static int PartOf(string name) { return (int)Native.Check(Native.physvib_part(Native.Utf8(name))); }
}

/// <summary>Where the enchanters sit; see physvib_layout.</summary>
public partial struct Layout {
    static Layout Create() {
        var made = new Layout();
        Native.Check(Native.physvib_layout_init(ref made, Native.SizeOf(made)));
        return made;
    }

    /// <summary>By its name, "phone4": they stand in Docs/panning.md.</summary>
    public static Layout Preset(string name) {
        var layout = Create();
        Native.Check(Native.physvib_layout_preset(Native.Utf8(name), ref layout));
        return layout;
    }
    public static Layout Load(string path) {
        var layout = Create();
        Native.Check(Native.physvib_layout_load(Native.Utf8(path), ref layout));
        return layout;
    }
    /// <summary>The same from text in memory.</summary>
    public static Layout Parse(string text) {
        var layout = Create();
        Native.Check(Native.physvib_layout_parse(Native.Utf8(text), ref layout));
        return layout;
    }
    public void Save(string path, string name) { Native.Check(Native.physvib_layout_save(Native.Utf8(path), Native.Utf8(name), ref this)); }
}

/// <summary>Begin with Create(), and change what you like.</summary>
public partial struct RendererSettings {
    public static RendererSettings Create() {
        var made = new RendererSettings();
        Native.Check(Native.physvib_renderer_settings_init(ref made, Native.SizeOf(made)));
        return made;
    }
}

public partial struct RendererStatus {
    internal static RendererStatus Create() {
        var made = new RendererStatus();
        Native.Check(Native.physvib_renderer_status_init(ref made, Native.SizeOf(made)));
        return made;
    }
}

/// <summary>Begin with Create(), and change what you like.</summary>
public partial struct WorldSettings {
    /// <summary>Of FullScaleImpulse_Ns: learned from the world's hits, see Docs/actuators.md.</summary>
    public const double Automatic = -1;
    public static WorldSettings Create() {
        var made = new WorldSettings();
        Native.Check(Native.physvib_world_settings_init(ref made, Native.SizeOf(made)));
        return made;
    }
}

/// <summary>Begin with Create(), and change what you like.</summary>
public partial struct Body {
    /// <summary>The names of the built-in materials that vibrate.</summary>
    public static string[] Materials {
        get {
            var names = new System.Collections.Generic.List<string>();
            for (IntPtr name; (name = Native.physvib_material_name(names.Count)) != IntPtr.Zero;) names.Add(Marshal.PtrToStringAnsi(name));
            return names.ToArray();
        }
    }
    /// <summary>Vibrates as that built-in material, or as one of a file of materials.</summary>
    public void SetMaterial(string name, string path = null) {
        Native.Check(path == null ? Native.physvib_material(Native.Utf8(name), ref this) : Native.physvib_material_load(Native.Utf8(path), Native.Utf8(name), ref this));
    }
    public static Body Create() {
        var made = new Body();
        Native.Check(Native.physvib_body_init(ref made, Native.SizeOf(made)));
        return made;
    }
}

/// <summary>Two bodies touch. Begin with Create(a, b), and tell the impulse, or the approach and the restitution.</summary>
public partial struct Contact {
    /// <summary>A number of yours, ByPlace, or -1: the pair is told as a whole.</summary>
    /// <summary>In space: across the plane of the field. Friction acts on b, instead of Tangential_Ns.</summary>
    public const int ByPlace = -2;
    public static Contact Create(int a, int b) {
        var made = new Contact();
        Native.Check(Native.physvib_contact_init(ref made, Native.SizeOf(made)));
        made.A = a;
        made.B = b;
        return made;
    }
}

/// <summary>What became of contacts, since the world was made; see physvib_world_counts.</summary>
public partial struct WorldCounts {
    internal static WorldCounts Create() {
        var made = new WorldCounts();
        Native.Check(Native.physvib_world_counts_init(ref made, Native.SizeOf(made)));
        return made;
    }
}

/// <summary>What was wrong, in one line; Code is one of PHYSVIB_ERROR_... .</summary>
public sealed class PhysVibException : Exception {
    public readonly int Code;
    internal PhysVibException(int code, string message) : base(message) { Code = code; }
}

/// <summary>Contacts in, events out. One thread at a time.</summary>
public sealed class World : IDisposable {
    internal IntPtr name;
    public World() : this(WorldSettings.Create()) {}
    public World(WorldSettings settings) { Native.Check(Native.physvib_world_create(ref settings, out name)); }
    ~World() { Dispose(); }
    public void Dispose() {
        if (name != IntPtr.Zero) Native.physvib_world_free(name);
        name = IntPtr.Zero;
        GC.SuppressFinalize(this);
    }
    public void Configure(WorldSettings settings) { Native.Check(Native.physvib_world_configure(name, ref settings)); }
    public void SetBody(int body, Body values) { Native.Check(Native.physvib_world_set_body(name, body, ref values)); }
    /// <summary>The mass that the engine gives a body now, 0: it does not move; its inertia changes by as much.</summary>
    public void SetMass(int body, double massKg) { Native.Check(Native.physvib_world_set_mass(name, body, massKg)); }
    public void RemoveBody(int body) { Native.Check(Native.physvib_world_remove_body(name, body)); }
    public void Move(int body, double x_m, double y_m, double vxMPerS, double vyMPerS, double spinRadPerS) {
        Native.Check(Native.physvib_world_move(name, body, x_m, y_m, vxMPerS, vyMPerS, spinRadPerS));
    }
    /// <summary>Behind the engine's solver: impulses that contacts do not tell follow from momentum.</summary>
    public void Moved(int body, double vxMPerS, double vyMPerS, double spinRadPerS) { Native.Check(Native.physvib_world_moved(name, body, vxMPerS, vyMPerS, spinRadPerS)); }
    /// <summary>Move in space, each of three numbers. The inverse of the moments of inertia is a symmetric matrix in the world's axes (xx, yy, zz, xy, xz, yz);
    /// null: InertiaKgM2 counts about every axis.</summary>
    public void MoveInSpace(int body, double[] centre_m, double[] velocityMPerS, double[] spinRadPerS, double[] inverseInertiaPerKgM2 = null) {
        Native.Numbers(inverseInertiaPerKgM2, 6);
        Native.Check(Native.physvib_world_move_in_space(name, body, Native.Numbers(centre_m, 3), Native.Numbers(velocityMPerS, 3), Native.Numbers(spinRadPerS, 3), inverseInertiaPerKgM2));
    }
    /// <summary>Moved in space.</summary>
    public void MovedInSpace(int body, double[] velocityMPerS, double[] spinRadPerS) {
        Native.Check(Native.physvib_world_moved_in_space(name, body, Native.Numbers(velocityMPerS, 3), Native.Numbers(spinRadPerS, 3)));
    }
    public void Pair(int surface, int other, double frequencyHz, double decayPerS, double gain) {
        Native.Check(Native.physvib_world_pair(name, surface, other, frequencyHz, decayPerS, gain));
    }
    public void BeginStep(double seconds, double gravityMPerS2) { Native.Check(Native.physvib_world_begin_step(name, seconds, gravityMPerS2)); }
    public void Touch(Contact contact) { Native.Check(Native.physvib_world_touch(name, ref contact)); }
    public void Begin(Contact contact) { Native.Check(Native.physvib_world_begin(name, ref contact)); }
    public void Push(Contact contact) { Native.Check(Native.physvib_world_push(name, ref contact)); }
    public void End(int a, int b) { Native.Check(Native.physvib_world_end(name, a, b)); }
    public void EndStep() { Native.Check(Native.physvib_world_end_step(name)); }
    public long TimeNs { get { return Native.Check(Native.physvib_world_time_ns(name)); } }
    public long Drops { get { return Native.Check(Native.physvib_world_drops(name)); } }
    public long Thinned { get { return Native.Check(Native.physvib_world_thinned(name)); } }
    public WorldCounts Counts {
        get {
            var counts = WorldCounts.Create();
            Native.Check(Native.physvib_world_get_counts(name, ref counts));
            return counts;
        }
    }
    /// <summary>Device of a body, also after it was removed; 0: of one that was never there.</summary>
    public int DeviceOf(int body) { return (int)Native.Check(Native.physvib_world_device(name, body)); }
    /// <summary>Why nothing, or not everything, is felt of what happened since the last call: the most likely reason, one sentence.</summary>
    public string Explain() { return Explanation.Of((text, size) => Native.Check(Native.physvib_world_explain(name, text, size))); }
    /// <summary>The same, also of a renderer that is pulled.</summary>
    public string Explain(Renderer renderer) { return Explanation.Of((text, size) => Native.Check(Native.physvib_renderer_explain(renderer.name, name, text, size))); }
    /// <summary>The same, also of any output.</summary>
    public string Explain(OutputFacts output) { return Explanation.Of((text, size) => Native.Check(Native.physvib_world_explain_output(name, ref output, text, size))); }
    /// <summary>What the engine says of a body now; call it before Explain, which forgets it.</summary>
    public void Note(int body, Note note) { Native.Check(Native.physvib_world_note(name, body, (int)note)); }
    /// <summary>Into an array of yours, so that nothing is allocated in a frame; how many.</summary>
    public int Take(Event[] events, bool atOnce = false) { return (int)Native.Check(Native.physvib_world_take(name, Event.Sized(events), events.Length, atOnce ? 1 : 0)); }
    public int Send(Renderer renderer, long laterNs, bool atOnce = false) {
        return (int)Native.Check(Native.physvib_world_send(name, renderer.name, laterNs, atOnce ? 1 : 0));
    }
}

/// <summary>Why an engine lets a body touch nothing; see physvib_world_note.</summary>
public enum Note { Sensor, Filtered, Disabled, Asleep }

/// <summary>What plays a world's events. Begin with Create(), and change what you like.</summary>
public partial struct OutputFacts {
    public static OutputFacts Create() {
        var made = new OutputFacts();
        Native.Check(Native.physvib_output_facts_init(ref made, Native.SizeOf(made)));
        return made;
    }
}

// Explanations with C#'s names: is_camera is IsCamera, physvib_world_set_body World.SetBody.
static class Explanation {
    internal static string Of(Action<byte[], UIntPtr> explain) {
        var text = new byte[512];
        explain(text, (UIntPtr)(uint)text.Length);
        var sentence = System.Text.Encoding.UTF8.GetString(text, 0, Array.IndexOf(text, (byte)0));
        return System.Text.RegularExpressions.Regex.Replace(sentence, @"(?<![\w/.])(physvib_([a-z]+)_)?([a-z]+(_[a-z0-9]+)+|[a-z]+)", match => {
            var word = match.Groups[3].Value;
            if (!match.Groups[1].Success && !word.Contains("_")) return match.Value;
            var parts = Array.ConvertAll(word.Split('_'), part => char.ToUpperInvariant(part[0]) + part.Substring(1));
            var owner = match.Groups[1].Success ? char.ToUpperInvariant(match.Groups[2].Value[0]) + match.Groups[2].Value.Substring(1) + "." : "";
            return owner + string.Concat(parts).Replace("WidthM", "Width_m").Replace("HeightM", "Height_m").Replace("ImpulseNS", "Impulse_Ns");
        });
    }
}

/// <summary>Strikes in, samples out.</summary>
public sealed class Renderer : IDisposable {
    internal IntPtr name;
    public Renderer() : this(RendererSettings.Create()) {}
    public Renderer(RendererSettings settings) { Native.Check(Native.physvib_renderer_create(ref settings, out name)); }
    ~Renderer() { Dispose(); }
    public void Dispose() {
        if (name != IntPtr.Zero) Native.physvib_renderer_free(name);
        name = IntPtr.Zero;
        GC.SuppressFinalize(this);
    }
    public void Strike(Event what) {
        what = what.Sized();
        Native.Check(Native.physvib_renderer_strike(name, ref what));
    }
    /// <summary>One impact at the next pull; strength: 0 to 1 of full scale. Of a built-in material, or else of 200 Hz.</summary>
    public void Impact(double x_m, double y_m, double strength, string material = null) {
        Native.Check(material == null ? Native.physvib_renderer_impact(name, x_m, y_m, strength) : Native.physvib_renderer_impact_of(name, Native.Utf8(material), x_m, y_m, strength));
    }
    /// <summary>Frame by frame; in the audio callback. An error code, and no exception.</summary>
    public int Pull(float[] samples, int channels) { return Native.physvib_renderer_pull_interleaved(name, samples, channels, samples.Length / channels); }
    public void SetGain(long timeNs, int channel, double gain) { Native.Check(Native.physvib_renderer_set_gain(name, timeNs, channel, gain)); }
    public void SetMute(long timeNs, int channel, bool isMuted) { Native.Check(Native.physvib_renderer_set_mute(name, timeNs, channel, isMuted ? 1 : 0)); }
    public void SetLevel(long timeNs, double gain) { Native.Check(Native.physvib_renderer_set_level(name, timeNs, gain)); }
    public void SetLayout(long timeNs, RendererSettings settings) { Native.Check(Native.physvib_renderer_set_layout(name, timeNs, ref settings)); }
    public void Silence(long timeNs, long untilNs) { Native.Check(Native.physvib_renderer_silence(name, timeNs, untilNs)); }
    public int LatencyFrames { get { return (int)Native.Check(Native.physvib_renderer_latency_frames(name)); } }
    public RendererStatus Status {
        get {
            var status = RendererStatus.Create();
            Native.Check(Native.physvib_renderer_get_status(name, ref status));
            return status;
        }
    }
}

/// <summary>Game controllers, for an engine that has a rumble call of its own: events in, motor commands out. One thread at a time.</summary>
public sealed class Pads : IDisposable {
    IntPtr name;
    /// <summary>Controllers are numbered from 0. profile: a name or a file of Docs/pads.md.</summary>
    public Pads(int count, double fieldWidth_m, double fieldHeight_m, string profile = "pad-generic") {
        Native.Check(Native.physvib_pads_create(count, fieldWidth_m, fieldHeight_m, Native.Utf8(profile), out name));
    }
    ~Pads() { Dispose(); }
    public void Dispose() {
        if (name != IntPtr.Zero) Native.physvib_pads_free(name);
        name = IntPtr.Zero;
        GC.SuppressFinalize(this);
    }
    /// <summary>An event at the time at which it is to be felt; one that is over, at the next pull.</summary>
    public void Strike(int pad, Event what) {
        what = what.Sized();
        Native.Check(Native.physvib_pads_strike(name, pad, ref what));
    }
    /// <summary>A world's events for one controller. How many.</summary>
    public int Send(int pad, World world, long laterNs, bool atOnce = false) {
        return (int)Native.Check(Native.physvib_pads_send(name, pad, world.name, laterNs, atOnce ? 1 : 0));
    }
    /// <summary>The commands to send now, into an array of yours with a place per controller: the strongest since the last pull.</summary>
    public void Pull(long untilNs, Motors[] motors) { Native.Check(Native.physvib_pads_pull(name, untilNs, motors, motors.Length)); }
    /// <summary>For a pause, or a new level: discards all events, and times may begin again.</summary>
    public void Stop() { Native.Check(Native.physvib_pads_stop(name)); }
    /// <summary>Of all events; 0 stops the motors.</summary>
    public void SetLevel(double gain) { Native.Check(Native.physvib_pads_set_level(name, gain)); }
}

public static class Haptics {
    public static string Version { get { return Marshal.PtrToStringAnsi(Native.physvib_version()); } }
    public static long PlayOutNs(int rateHz, int blockFrames, int stepsPerS, double longestGapS) {
        return Native.Check(Native.physvib_play_out_ns(rateHz, blockFrames, stepsPerS, longestGapS));
    }
    /// <summary>samples[channel * frames + n], as many channels as the settings say.</summary>
    public static float[] Render(RendererSettings settings, Event[] events, int count, long frames) {
        if (count < 0 || count > events.Length) throw new ArgumentOutOfRangeException("count");
        var samples = new float[checked(Math.Max(settings.Channels, settings.Layout.Count) * frames)];
        Native.Check(Native.physvib_render(ref settings, Event.Sized(events), count, frames, samples));
        return samples;
    }
    public static void SaveWav(string path, float[] samples, int channels, int rateHz) {
        Native.Check(Native.physvib_wav_save(Native.Utf8(path), samples, channels, samples.Length / Math.Max(1, channels), rateHz));
    }
    public static Event[] LoadEvents(string path) {
        var events = new Event[Native.Check(Native.physvib_events_load(Native.Utf8(path), null, 0))];
        var count = Native.Check(Native.physvib_events_load(Native.Utf8(path), Event.Sized(events), events.Length));
        if (count != events.Length) Array.Resize(ref events, (int)Math.Min(count, events.Length)); // another file by now
        return events;
    }
    /// <summary>The same from text in memory.</summary>
    public static Event[] ParseEvents(string text) {
        var events = new Event[Native.Check(Native.physvib_events_parse(Native.Utf8(text), null, 0))];
        Native.Check(Native.physvib_events_parse(Native.Utf8(text), Event.Sized(events), events.Length));
        return events;
    }
    /// <summary>Of a law of panning, as they are counted from 0.</summary>
    public static string LawName(int law) { return Marshal.PtrToStringAnsi(Native.physvib_law_name(law)); }
    public static void SaveEvents(string path, Event[] events) { Native.Check(Native.physvib_events_save(Native.Utf8(path), Event.Sized(events), events.Length)); }
    /// <summary>The same, with the field that its places span, in metres.</summary>
    public static void SaveEvents(string path, Event[] events, double widthM, double heightM) { Native.Check(Native.physvib_events_save_field(Native.Utf8(path), Event.Sized(events), events.Length, widthM, heightM)); }
    /// <summary>The field that a list says, in metres, for a renderer's settings; 0 and 0: none.</summary>
    public static void LoadField(string path, out double widthM, out double heightM) { Native.Check(Native.physvib_events_load_field(Native.Utf8(path), out widthM, out heightM)); }
    /// <summary>The same from text in memory.</summary>
    public static void ParseField(string text, out double widthM, out double heightM) { Native.Check(Native.physvib_events_parse_field(Native.Utf8(text), out widthM, out heightM)); }
}

/// <summary>How the library is called on each system. Unity finds it by its bare name, and Mono by the name that Linux has.</summary>
public static class LibraryNames {
    /// <summary>The names that are tried for "libphysvib.so.1", in their order; PHYSVIB_LIBRARY (or PHYSVIB_LIVE_LIBRARY) comes first.</summary>
    public static string[] Of(string library, PlatformID system, bool isMac) {
        var bare = library.Replace("lib", "").Replace(".so.1", "");
        if (isMac) return new[] { "lib" + bare + ".1.dylib", "lib" + bare + ".dylib" };
        if (system == PlatformID.Win32NT) return new[] { "lib" + bare + ".dll", bare + ".dll" };
        return new[] { library, "lib" + bare + ".so" };
    }

    static bool isFollowed;

    /// <summary>.NET asks us which file is meant (NativeLibrary.SetDllImportResolver); Mono has no such question, and nothing happens.</summary>
    internal static void Follow() {
        var loader = Type.GetType("System.Runtime.InteropServices.NativeLibrary");
        if (loader == null || isFollowed) return;
        isFollowed = true;
        var set = loader.GetMethod("SetDllImportResolver");
        var question = set.GetParameters()[1].ParameterType;
        var answer = typeof(LibraryNames).GetMethod("Find", System.Reflection.BindingFlags.NonPublic | System.Reflection.BindingFlags.Static);
        var search = question.GetMethod("Invoke").GetParameters()[2].ParameterType; // DllImportSearchPath?
        set.Invoke(null, new object[] { typeof(LibraryNames).Assembly, Delegate.CreateDelegate(question, answer.MakeGenericMethod(search)) });
    }

    static IntPtr Find<T>(string library, System.Reflection.Assembly asking, T search) {
        var loader = Type.GetType("System.Runtime.InteropServices.NativeLibrary");
        var load = loader.GetMethod("TryLoad", new[] { typeof(string), typeof(System.Reflection.Assembly), typeof(T), typeof(IntPtr).MakeByRefType() });
        var chosen = Environment.GetEnvironmentVariable(library.Contains("live") ? "PHYSVIB_LIVE_LIBRARY" : "PHYSVIB_LIBRARY");
        var isMac = System.IO.File.Exists("/System/Library/CoreServices/SystemVersion.plist");
        var names = new System.Collections.Generic.List<string>(Of(library, Environment.OSVersion.Platform, isMac));
        if (!string.IsNullOrEmpty(chosen)) names.Insert(0, chosen);
        foreach (var name in names) {
            var values = new object[] { name, asking, search, IntPtr.Zero };
            if ((bool)load.Invoke(null, values)) return (IntPtr)values[3];
        }
        return IntPtr.Zero;
    }
}

static partial class Native {
#if UNITY_5_3_OR_NEWER
    const string Library = "physvib";
#else
    const string Library = "libphysvib.so.1";
#endif
    static Native() { LibraryNames.Follow(); }

    internal static long Check(long result) {
        if (result < 0) throw new PhysVibException((int)result, Marshal.PtrToStringAnsi(physvib_error()));
        return result;
    }
    internal static UIntPtr SizeOf<T>(T what) { return (UIntPtr)(uint)Marshal.SizeOf(typeof(T)); }
    internal static byte[] Utf8OrNull(string text) { return text == null ? null : Utf8(text); }
    internal static byte[] Utf8(string text) { return System.Text.Encoding.UTF8.GetBytes(text + "\0"); }

    internal static double[] Numbers(double[] found, int expected) { // an array without them is for the library to refuse
        if (found != null && found.Length != expected) throw new ArgumentException("expected " + expected + " numbers");
        return found;
    }
}

// Written by Source/Api/bindings.py: change the header, not this.
[StructLayout(LayoutKind.Sequential)]
public partial struct Event {
    UIntPtr size;
    public long TimeNs, DurationNs;
    public double FrequencyHz, DecayPerS, Amplitude, X_m, Y_m, Impulse_Ns, MassKg;
    public int Fixture, Other;
    public Kind Kind;
    public int Sound;
    public double Z_m;
    public int Part;
    int unused;
}

[StructLayout(LayoutKind.Sequential)]
public partial struct Layout {
    UIntPtr size;
    public double ExtentWidth_m, ExtentHeight_m;
    [MarshalAs(UnmanagedType.ByValArray, SizeConst = 64)] public double[] X_m;
    [MarshalAs(UnmanagedType.ByValArray, SizeConst = 64)] public double[] Y_m;
    public int Count;
    [MarshalAs(UnmanagedType.ByValArray, SizeConst = 64)] public double[] Z_m;
    [MarshalAs(UnmanagedType.ByValArray, SizeConst = 64)] public int[] Part;
}

[StructLayout(LayoutKind.Sequential)]
public partial struct RendererSettings {
    UIntPtr size;
    public int RateHz, Channels, Law, Limiter;
    public double Exponent, FieldWidth_m, FieldHeight_m;
    public Layout Layout;
}

[StructLayout(LayoutKind.Sequential)]
public partial struct RendererStatus {
    UIntPtr size;
    public int LiveModes, Pending;
    public long Frames, Played, Late, Rejected, Refused;
}

[StructLayout(LayoutKind.Sequential)]
public partial struct WorldSettings {
    UIntPtr size;
    public int IsMuted, HitsPerStep, AtBody, DropsHitsOfRemoved;
    public double FieldWidth_m, FieldX_m, FieldY_m, FieldRadians, NormalisationSPerM, HandMassKg, DriveGain, ThresholdMPerS, FullScaleImpulse_Ns, SettlingS;
}

[StructLayout(LayoutKind.Sequential)]
public partial struct Body {
    UIntPtr size;
    public int IsCamera, Voice, Surface;
    public double MassKg, InertiaKgM2, GravityScale, FrequencyHz, DecayPerS, StaticMassKg, Gain, HandMassKg;
    [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] OvertoneHz;
    [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] OvertoneDecayPerS;
    [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] OvertoneAmplitude;
    public double Grain_m, Roughness, Rolling;
    public int IsRidged, Device, Part;
}

[StructLayout(LayoutKind.Sequential)]
public partial struct Contact {
    UIntPtr size;
    public int A, B;
    public double X_m, Y_m, NormalX, NormalY, Impulse_Ns, Tangential_Ns, ApproachMPerS, Restitution, EffectiveMassKg, Fraction, Gap_m, GapFraction, AlongAMPerS, AlongBMPerS;
    public int IsSoft, PointId, IsImpulseOfPair;
    public double Z_m, NormalZ, FrictionX_Ns, FrictionY_Ns, FrictionZ_Ns;
}

[StructLayout(LayoutKind.Sequential)]
public partial struct WorldCounts {
    UIntPtr size;
    public long Contacts, BelowThreshold, NoSource, Unplayable, Muted, Dropped, Events;
    public double ThresholdMPerS;
}

[StructLayout(LayoutKind.Sequential)]
public partial struct OutputFacts {
    UIntPtr size;
    public int IsMissing, IsSilent, Channels;
    public double Level;
    public long MutedChannels, Late, Dropped, Rejected;
    IntPtr silentBy, trouble, renderer;
    public long WithoutPart;
}

[StructLayout(LayoutKind.Sequential)]
public partial struct Motors {
    public double Low, High;
}

static partial class Native {
    [DllImport(Library)] internal static extern IntPtr physvib_version();
    [DllImport(Library)] internal static extern IntPtr physvib_law_name(int law);
    [DllImport(Library)] internal static extern IntPtr physvib_error();
    [DllImport(Library)] internal static extern int physvib_renderer_settings_init(ref RendererSettings settings, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_renderer_status_init(ref RendererStatus status, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_world_settings_init(ref WorldSettings settings, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_body_init(ref Body body, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_contact_init(ref Contact contact, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_world_counts_init(ref WorldCounts counts, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_output_facts_init(ref OutputFacts facts, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_event_init(ref Event what, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_layout_init(ref Layout layout, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_layout_preset(byte[] name, ref Layout layout);
    [DllImport(Library)] internal static extern int physvib_layout_load(byte[] path, ref Layout layout);
    [DllImport(Library)] internal static extern int physvib_layout_parse(byte[] text, ref Layout layout);
    [DllImport(Library)] internal static extern int physvib_layout_save(byte[] path, byte[] name, ref Layout layout);
    [DllImport(Library)] internal static extern int physvib_part(byte[] name);
    [DllImport(Library)] internal static extern long physvib_events_load(byte[] path, [In, Out] Event[] events, long capacity);
    [DllImport(Library)] internal static extern long physvib_events_parse(byte[] text, [In, Out] Event[] events, long capacity);
    [DllImport(Library)] internal static extern int physvib_events_load_field(byte[] path, out double widthM, out double heightM);
    [DllImport(Library)] internal static extern int physvib_events_parse_field(byte[] text, out double widthM, out double heightM);
    [DllImport(Library)] internal static extern int physvib_events_save(byte[] path, Event[] events, long count);
    [DllImport(Library)] internal static extern int physvib_events_save_field(byte[] path, Event[] events, long count, double widthM, double heightM);
    [DllImport(Library)] internal static extern int physvib_wav_save(byte[] path, float[] samples, int channels, long frames, int rateHz);
    [DllImport(Library)] internal static extern int physvib_render(ref RendererSettings settings, Event[] events, long count, long frames, [In, Out] float[] samples);
    [DllImport(Library)] internal static extern IntPtr physvib_material_name(int index);
    [DllImport(Library)] internal static extern int physvib_material(byte[] name, ref Body body);
    [DllImport(Library)] internal static extern int physvib_material_load(byte[] path, byte[] name, ref Body body);
    [DllImport(Library)] internal static extern int physvib_sound(byte[] name);
    [DllImport(Library)] internal static extern int physvib_event_of(byte[] material, double xM, double yM, double strength, ref Event what);
    [DllImport(Library)] internal static extern int physvib_renderer_create(ref RendererSettings settings, out IntPtr renderer);
    [DllImport(Library)] internal static extern int physvib_renderer_free(IntPtr renderer);
    [DllImport(Library)] internal static extern int physvib_renderer_strike(IntPtr renderer, ref Event what);
    [DllImport(Library)] internal static extern int physvib_renderer_impact(IntPtr renderer, double xM, double yM, double strength);
    [DllImport(Library)] internal static extern int physvib_renderer_impact_of(IntPtr renderer, byte[] material, double xM, double yM, double strength);
    [DllImport(Library)] internal static extern int physvib_renderer_pull(IntPtr renderer, IntPtr[] channels, int channelCount, int frames);
    [DllImport(Library)] internal static extern int physvib_renderer_pull_interleaved(IntPtr renderer, [In, Out] float[] samples, int channelCount, int frames);
    [DllImport(Library)] internal static extern int physvib_renderer_set_gain(IntPtr renderer, long timeNs, int channel, double gain);
    [DllImport(Library)] internal static extern int physvib_renderer_set_mute(IntPtr renderer, long timeNs, int channel, int isMuted);
    [DllImport(Library)] internal static extern int physvib_renderer_set_level(IntPtr renderer, long timeNs, double gain);
    [DllImport(Library)] internal static extern int physvib_renderer_set_layout(IntPtr renderer, long timeNs, ref RendererSettings settings);
    [DllImport(Library)] internal static extern int physvib_renderer_silence(IntPtr renderer, long timeNs, long untilNs);
    [DllImport(Library)] internal static extern int physvib_renderer_latency_frames(IntPtr renderer);
    [DllImport(Library)] internal static extern int physvib_renderer_get_status(IntPtr renderer, ref RendererStatus status);
    [DllImport(Library)] internal static extern long physvib_play_out_ns(int rateHz, int blockFrames, int stepsPerS, double longestGapS);
    [DllImport(Library)] internal static extern int physvib_world_create(ref WorldSettings settings, out IntPtr world);
    [DllImport(Library)] internal static extern int physvib_world_free(IntPtr world);
    [DllImport(Library)] internal static extern int physvib_world_configure(IntPtr world, ref WorldSettings settings);
    [DllImport(Library)] internal static extern int physvib_world_set_body(IntPtr world, int body, ref Body values);
    [DllImport(Library)] internal static extern int physvib_world_set_mass(IntPtr world, int body, double massKg);
    [DllImport(Library)] internal static extern int physvib_world_device(IntPtr world, int body);
    [DllImport(Library)] internal static extern int physvib_world_remove_body(IntPtr world, int body);
    [DllImport(Library)] internal static extern int physvib_world_move(IntPtr world, int body, double xM, double yM, double vxMPerS, double vyMPerS, double spinRadPerS);
    [DllImport(Library)] internal static extern int physvib_world_moved(IntPtr world, int body, double vxMPerS, double vyMPerS, double spinRadPerS);
    [DllImport(Library)] internal static extern int physvib_world_move_in_space(IntPtr world, int body, double[] centreM, double[] velocityMPerS, double[] spinRadPerS, double[] inverseInertiaPerKgM2);
    [DllImport(Library)] internal static extern int physvib_world_moved_in_space(IntPtr world, int body, double[] velocityMPerS, double[] spinRadPerS);
    [DllImport(Library)] internal static extern int physvib_world_pair(IntPtr world, int surface, int other, double frequencyHz, double decayPerS, double gain);
    [DllImport(Library)] internal static extern int physvib_world_begin_step(IntPtr world, double seconds, double gravityMPerS2);
    [DllImport(Library)] internal static extern int physvib_world_touch(IntPtr world, ref Contact contact);
    [DllImport(Library)] internal static extern int physvib_world_begin(IntPtr world, ref Contact contact);
    [DllImport(Library)] internal static extern int physvib_world_push(IntPtr world, ref Contact contact);
    [DllImport(Library)] internal static extern int physvib_world_end(IntPtr world, int a, int b);
    [DllImport(Library)] internal static extern int physvib_world_end_step(IntPtr world);
    [DllImport(Library)] internal static extern long physvib_world_time_ns(IntPtr world);
    [DllImport(Library)] internal static extern long physvib_world_take(IntPtr world, [In, Out] Event[] events, long capacity, int atOnce);
    [DllImport(Library)] internal static extern long physvib_world_send(IntPtr world, IntPtr renderer, long laterNs, int atOnce);
    [DllImport(Library)] internal static extern long physvib_world_drops(IntPtr world);
    [DllImport(Library)] internal static extern int physvib_world_get_counts(IntPtr world, ref WorldCounts counts);
    [DllImport(Library)] internal static extern int physvib_world_explain(IntPtr world, [Out] byte[] text, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_world_explain_output(IntPtr world, ref OutputFacts facts, [Out] byte[] text, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_renderer_explain(IntPtr renderer, IntPtr world, [Out] byte[] text, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_world_note(IntPtr world, int body, int note);
    [DllImport(Library)] internal static extern long physvib_world_thinned(IntPtr world);
    [DllImport(Library)] internal static extern int physvib_pads_create(int count, double fieldWidthM, double fieldHeightM, byte[] profile, out IntPtr pads);
    [DllImport(Library)] internal static extern int physvib_pads_free(IntPtr pads);
    [DllImport(Library)] internal static extern int physvib_pads_strike(IntPtr pads, int pad, ref Event what);
    [DllImport(Library)] internal static extern long physvib_pads_send(IntPtr pads, int pad, IntPtr world, long laterNs, int atOnce);
    [DllImport(Library)] internal static extern int physvib_pads_pull(IntPtr pads, long untilNs, [In, Out] Motors[] motors, int capacity);
    [DllImport(Library)] internal static extern int physvib_pads_stop(IntPtr pads);
    [DllImport(Library)] internal static extern int physvib_pads_set_level(IntPtr pads, double gain);
}
// End of what bindings.py has written.

}
