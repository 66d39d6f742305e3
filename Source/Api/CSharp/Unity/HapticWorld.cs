// SPDX-License-Identifier: MIT
// Component for the object with the AudioListener in Unity, 2D: steps the world and mixes its output into the audio. Untried in Unity; Docs/csharp.md says how to set it up.
using System.Collections.Generic;
using PhysVib;
using UnityEngine;
using Event = PhysVib.Event; // UnityEngine has an Event and a Renderer as well
using Renderer = PhysVib.Renderer;

[DefaultExecutionOrder(-100)] // before the bodies
public class HapticWorld : MonoBehaviour {
    public static HapticWorld it;
    public Vector2 corner = new Vector2(-5, -3), size = new Vector2(10, 6); // area that the actuators span, m
    public float driveGain = 1;
    public int firstOutput = 4;
    public World world;
    public readonly List<int> gone = new List<int>();
    Renderer output;
    RendererSettings settings;
    readonly Event[] events = new Event[256];
    float[] samples = new float[0];
    long laterNs, startNs;
    int next = 1; // 0: all bodies without a HapticBody
    bool isStepping;

    public int Next() { return next++; }

    void Awake() {
        it = this;
        var how = WorldSettings.Create();
        how.FieldWidth_m = size.x;
        how.FieldX_m = corner.x;
        how.FieldY_m = corner.y;
        how.DriveGain = driveGain;
        how.FullScaleImpulse_Ns = WorldSettings.Automatic; // driveGain 1: the hardest typical hit has half of full scale
        world = new World(how);
        world.SetBody(0, Body.Create());
        settings = RendererSettings.Create(); // phone4: A upper left, B upper right, C and D below
        settings.RateHz = AudioSettings.outputSampleRate;
        settings.FieldWidth_m = size.x;
        settings.FieldHeight_m = size.y;
        AudioSettings.GetDSPBufferSize(out int frames, out int count);
        laterNs = Haptics.PlayOutNs(settings.RateHz, frames, Mathf.RoundToInt(1 / Time.fixedDeltaTime), 0.05);
        output = new Renderer(settings);
    }

    void FixedUpdate() { // Unity steps its world and calls OnCollision... between two of these
        if (isStepping) {
            world.EndStep();
            Send();
        }
        foreach (int body in gone) world.RemoveBody(body); // not allowed within a step
        gone.Clear();
        world.BeginStep(Time.fixedDeltaTime, Physics2D.gravity.magnitude);
        isStepping = true;
    }

    void Send() { // converts world time to audio time, and aligns them again when they differ by 0.05 s
        long apart = output.Status.Frames * 1000000000L / settings.RateHz - world.TimeNs;
        if (System.Math.Abs(apart - startNs) > 50000000) startNs = apart;
        int count = world.Take(events);
        for (int i = 0; i < count; ++i) {
            events[i].TimeNs = System.Math.Max(0, events[i].TimeNs + startNs + laterNs);
            output.Strike(events[i]);
        }
    }

    void OnAudioFilterRead(float[] data, int channels) { // Unity's audio thread
        if (output == null || channels < firstOutput + 4) return;
        int frames = data.Length / channels;
        if (samples.Length != 4 * frames) samples = new float[4 * frames];
        if (output.Pull(samples, 4) != 0) return;
        for (int n = 0; n < frames; ++n)
            for (int j = 0; j < 4; ++j) data[n * channels + firstOutput + j] += samples[4 * n + j];
    }

    void OnDestroy() {
        output.Dispose();
        world.Dispose();
    }
}
