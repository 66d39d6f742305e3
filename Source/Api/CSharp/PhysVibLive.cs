// SPDX-License-Identifier: MIT
// A device or a board from C#, beside PhysVib.cs: one file over libphysvib-live. Units, threads and errors: physvib-live.h.
using System;
using System.Runtime.InteropServices;

namespace PhysVib {

/// <summary>Begin with Create(), and change what you like; see physvib_live_settings.</summary>
public partial struct LiveSettings {
    /// <summary>A session file (.json) of all that is struck, written while it plays; "": none.</summary>
    public string Save {
        get { return System.Text.Encoding.UTF8.GetString(save, 0, Math.Max(0, Array.IndexOf(save, (byte)0))); }
        set {
            var path = System.Text.Encoding.UTF8.GetBytes(value);
            if (path.Length >= 1024) throw new ArgumentException("Save: expected a path of at most 1023 bytes");
            save = new byte[1024];
            path.CopyTo(save, 0);
        }
    }
    public static LiveSettings Create() {
        var made = new LiveSettings();
        LiveNative.Check(LiveNative.physvib_live_settings_init(ref made, Native.SizeOf(made)));
        return made;
    }
}

/// <summary>What it does, and what is wrong; see physvib_live_status.</summary>
public partial struct LiveStatus {
    /// <summary>What is missing, one line; "": nothing.</summary>
    public string Trouble { get { return System.Text.Encoding.UTF8.GetString(trouble, 0, Math.Max(0, Array.IndexOf(trouble, (byte)0))); } }
    internal static LiveStatus Create() {
        var made = new LiveStatus();
        LiveNative.Check(LiveNative.physvib_live_status_init(ref made, Native.SizeOf(made)));
        return made;
    }
}

/// <summary>What left for an actuator in a span of session time; see physvib_live_receipt.</summary>
public partial struct LiveReceipt {
    internal static LiveReceipt Create() {
        var made = new LiveReceipt();
        LiveNative.Check(LiveNative.physvib_live_receipt_init(ref made, Native.SizeOf(made)));
        return made;
    }
}

/// <summary>Something that can be opened; see physvib_device.</summary>
public partial struct Device {
    public string Name { get { return Text(name); } }
    public string About { get { return Text(about); } }
    static string Text(byte[] from) { return System.Text.Encoding.UTF8.GetString(from, 0, Math.Max(0, Array.IndexOf(from, (byte)0))); }
}

/// <summary>A device ("JACK:system"), a board ("BOARD:auto"), or both ("JACK:system+BOARD:auto"). Several may be open, also on one sound card, on other outputs (FirstOutput); strikes from any thread.</summary>
public sealed class Live : IDisposable {
    IntPtr name;
    // Session time of each followed world's time 0. A world that is collected leaves the table.
    readonly System.Runtime.CompilerServices.ConditionalWeakTable<World, long[]> starts = new System.Runtime.CompilerServices.ConditionalWeakTable<World, long[]>();
    public Live(string device) : this(device, RendererSettings.Create(), LiveSettings.Create()) {}
    public Live(string device, RendererSettings renderer, LiveSettings settings) {
        LiveNative.Check(LiveNative.physvib_live_open(Native.Utf8(device), ref renderer, ref settings, out name));
    }
    ~Live() {
        if (name != IntPtr.Zero) LiveNative.physvib_live_close(name);
    }
    /// <summary>Silent within two blocks, then closed, also if it says that not all of the session is saved.</summary>
    public void Dispose() {
        var open = name;
        name = IntPtr.Zero;
        GC.SuppressFinalize(this);
        if (open != IntPtr.Zero) LiveNative.Check(LiveNative.physvib_live_close(open));
    }
    /// <summary>Session time.</summary>
    public long NowNs { get { return LiveNative.Check(LiveNative.physvib_live_now_ns(name)); } }
    /// <summary>The output latency L: what is struck at session time t leaves for the device at t + L.</summary>
    public long LatencyNs { get { return LiveNative.Check(LiveNative.physvib_live_latency_ns(name)); } }
    /// <summary>Events at session times; those that are over, at once.</summary>
    public void Strike(params Event[] events) { LiveNative.Check(LiveNative.physvib_live_strike(name, Event.Sized(events), events.Length)); }
    /// <summary>One impact now; strength: 0 to 1 of full scale. Of a built-in material, or else of 200 Hz.</summary>
    public void Impact(double x_m, double y_m, double strength, string material = null) {
        LiveNative.Check(material == null ? LiveNative.physvib_live_impact(name, x_m, y_m, strength) : LiveNative.physvib_live_impact_of(name, Native.Utf8(material), x_m, y_m, strength));
    }
    /// <summary>The events of a world whose time 0 is session time startNs. How many.</summary>
    public int Send(World world, long startNs, bool atOnce = false) { return (int)LiveNative.Check(LiveNative.physvib_live_send(name, world.name, startNs, atOnce ? 1 : 0)); }
    /// <summary>For a world that is stepped as time goes on, after each step: sends its events. How many. Each world keeps a rhythm of its own.</summary>
    public int Follow(World world) {
        var start = starts.GetValue(world, _ => new long[1]);
        LiveNative.Check(LiveNative.physvib_live_align(name, world.name, ref start[0]));
        return Send(world, start[0]);
    }
    /// <summary>As Follow for a world whose bodies are felt on several devices: those whose Device is k on lives[k], all others on the first.</summary>
    public static int FollowEach(Live[] lives, World world) {
        var names = Array.ConvertAll(lives, live => live.name);
        var times = Array.ConvertAll(lives, live => live.starts.GetValue(world, _ => new long[1])[0]);
        var count = LiveNative.Check(LiveNative.physvib_live_send_each(names, lives.Length, world.name, times));
        for (var k = 0; k < lives.Length; ++k) lives[k].starts.GetValue(world, _ => new long[1])[0] = times[k];
        return (int)count;
    }
    /// <summary>What can be opened now. It asks the system, which takes up to seconds.</summary>
    public static Device[] Devices() {
        var found = new Device[256];
        var count = (int)LiveNative.Check(LiveNative.physvib_live_devices(found, found.Length, (UIntPtr)Marshal.SizeOf(typeof(Device))));
        Array.Resize(ref found, Math.Min(count, found.Length));
        return found;
    }
    /// <summary>Session time of the time 0 of a followed world; 0: it is not followed yet.</summary>
    public long StartNs(World world) {
        long[] start;
        return starts.TryGetValue(world, out start) ? start[0] : 0;
    }
    public void SetGain(int channel, double gain) { LiveNative.Check(LiveNative.physvib_live_set_gain(name, channel, gain)); }
    public void SetMute(int channel, bool isMuted) { LiveNative.Check(LiveNative.physvib_live_set_mute(name, channel, isMuted ? 1 : 0)); }
    public void SetLayout(RendererSettings renderer) { LiveNative.Check(LiveNative.physvib_live_set_layout(name, ref renderer)); }
    public void SetLevel(double levelDb) { LiveNative.Check(LiveNative.physvib_live_set_level(name, levelDb)); }
    public void Silence(bool isSilent = true) { LiveNative.Check(LiveNative.physvib_live_silence(name, isSilent ? 1 : 0)); }
    /// <summary>What left for an actuator, from 0, between two session times; see physvib_live_left.</summary>
    public LiveReceipt Left(long fromNs, long toNs, int actuator) {
        var receipt = LiveReceipt.Create();
        LiveNative.Check(LiveNative.physvib_live_left(name, fromNs, toNs, actuator, ref receipt));
        return receipt;
    }
    /// <summary>As World.Explain, also of this device.</summary>
    public string Explain(World world) { return Explanation.Of((text, size) => LiveNative.Check(LiveNative.physvib_live_explain(name, world.name, text, size))); }
    public LiveStatus Status {
        get {
            var status = LiveStatus.Create();
            LiveNative.Check(LiveNative.physvib_live_get_status(name, ref status));
            return status;
        }
    }
}

static partial class LiveNative {
#if UNITY_5_3_OR_NEWER
    const string Library = "physvib-live";
#else
    const string Library = "libphysvib-live.so.1";
#endif
    static LiveNative() { LibraryNames.Follow(); }

    internal static long Check(long result) {
        if (result < 0) throw new PhysVibException((int)result, Marshal.PtrToStringAnsi(physvib_live_error()));
        return result;
    }

}

// Written by Source/Api/bindings.py: change the header, not this.
[StructLayout(LayoutKind.Sequential)]
public partial struct LiveSettings {
    UIntPtr size;
    public int RateHz, BlockFrames, StepsPerS;
    public double LongestGapS, LevelDb;
    [MarshalAs(UnmanagedType.ByValArray, SizeConst = 1024)] byte[] save;
    public int FirstOutput, SoundOutput;
    public double SoundDb;
}

[StructLayout(LayoutKind.Sequential)]
public partial struct LiveStatus {
    UIntPtr size;
    public int IsRunning, IsSilent, RateHz, BlockFrames, LiveModes, Losses, Xruns;
    public double Load, WorstLoad;
    public long Played, Late, Rejected;
    [MarshalAs(UnmanagedType.ByValArray, SizeConst = 256)] byte[] trouble;
    public int Board;
    public long BoardSent, BoardLost, Dropped;
}

[StructLayout(LayoutKind.Sequential)]
public partial struct LiveReceipt {
    UIntPtr size;
    public long Frames;
    public double Peak, MeanSquare;
    public int Running, Opening, Over, Kept;
}

[StructLayout(LayoutKind.Sequential)]
public partial struct Device {
    UIntPtr size;
    [MarshalAs(UnmanagedType.ByValArray, SizeConst = 256)] byte[] name;
    [MarshalAs(UnmanagedType.ByValArray, SizeConst = 256)] byte[] about;
    public int Kind, Channels;
}

static partial class LiveNative {
    [DllImport(Library)] internal static extern IntPtr physvib_live_error();
    [DllImport(Library)] internal static extern int physvib_live_settings_init(ref LiveSettings settings, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_live_status_init(ref LiveStatus status, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_live_receipt_init(ref LiveReceipt receipt, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_live_devices([In, Out] Device[] devices, int capacity, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_live_open(byte[] device, ref RendererSettings renderer, ref LiveSettings settings, out IntPtr live);
    [DllImport(Library)] internal static extern int physvib_live_close(IntPtr live);
    [DllImport(Library)] internal static extern long physvib_live_now_ns(IntPtr live);
    [DllImport(Library)] internal static extern long physvib_live_latency_ns(IntPtr live);
    [DllImport(Library)] internal static extern int physvib_live_strike(IntPtr live, Event[] events, long count);
    [DllImport(Library)] internal static extern int physvib_live_impact(IntPtr live, double xM, double yM, double strength);
    [DllImport(Library)] internal static extern int physvib_live_impact_of(IntPtr live, byte[] material, double xM, double yM, double strength);
    [DllImport(Library)] internal static extern int physvib_live_align(IntPtr live, IntPtr world, ref long startNs);
    [DllImport(Library)] internal static extern long physvib_live_send(IntPtr live, IntPtr world, long startNs, int atOnce);
    [DllImport(Library)] internal static extern long physvib_live_send_each(IntPtr[] lives, int count, IntPtr world, [In, Out] long[] startsNs);
    [DllImport(Library)] internal static extern int physvib_live_set_gain(IntPtr live, int channel, double gain);
    [DllImport(Library)] internal static extern int physvib_live_set_mute(IntPtr live, int channel, int isMuted);
    [DllImport(Library)] internal static extern int physvib_live_set_layout(IntPtr live, ref RendererSettings renderer);
    [DllImport(Library)] internal static extern int physvib_live_set_level(IntPtr live, double levelDb);
    [DllImport(Library)] internal static extern int physvib_live_silence(IntPtr live, int isSilent);
    [DllImport(Library)] internal static extern int physvib_live_get_status(IntPtr live, ref LiveStatus status);
    [DllImport(Library)] internal static extern int physvib_live_left(IntPtr live, long fromNs, long toNs, int actuator, ref LiveReceipt receipt);
    [DllImport(Library)] internal static extern int physvib_live_explain(IntPtr live, IntPtr world, [Out] byte[] text, UIntPtr size);
    [DllImport(Library)] internal static extern int physvib_session_load(byte[] path, out IntPtr session);
    [DllImport(Library)] internal static extern int physvib_session_create(ref RendererSettings renderer, Event[] events, long count, long lengthNs, out IntPtr session);
    [DllImport(Library)] internal static extern int physvib_session_free(IntPtr session);
    [DllImport(Library)] internal static extern int physvib_session_save(IntPtr session, byte[] path);
    [DllImport(Library)] internal static extern long physvib_session_length_ns(IntPtr session);
    [DllImport(Library)] internal static extern int physvib_session_get_renderer(IntPtr session, ref RendererSettings renderer);
    [DllImport(Library)] internal static extern long physvib_session_events(IntPtr session, long endNs, [In, Out] Event[] events, long capacity);
    [DllImport(Library)] internal static extern int physvib_session_render(IntPtr session, int rateHz, long frames, [In, Out] float[] samples);
}
// End of what bindings.py has written.

}
