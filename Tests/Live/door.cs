// SPDX-License-Identifier: GPL-3.0-or-later
// door.c once more, by C#'s default call: door.exe SECONDS STEPS_PER_S; libphysvib-port-onsets.so is where libraries are looked for.
using System;
using System.Diagnostics;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Threading;
using PhysVib;

static class Door {
    [DllImport("physvib-port-onsets")] static extern int door_listen(IntPtr live);
    [DllImport("physvib-port-onsets")] static extern void door_leave();
    [DllImport("physvib-port-onsets")] static extern long door_onset(int k);

    static int Main(string[] words) {
        int seconds = int.Parse(words[0]), rate = int.Parse(words[1]);
        var renderer = RendererSettings.Create();
        renderer.FieldWidth_m = renderer.FieldHeight_m = 1;
        using (var live = new Live("JACK:system", renderer, LiveSettings.Create()))
        using (var world = new World()) {
            var name = (IntPtr)typeof(Live).GetField("name", BindingFlags.NonPublic | BindingFlags.Instance).GetValue(live);
            if (door_listen(name) != 0) return 1;
            world.SetBody(0, Body.Create());
            var ball = Body.Create();
            ball.IsCamera = 1;
            ball.MassKg = 1;
            ball.FrequencyHz = 1000;
            ball.DecayPerS = 200;
            world.SetBody(1, ball);
            var contact = Contact.Create(0, 1);
            contact.X_m = contact.Y_m = 0.5;
            contact.ApproachMPerS = 3;
            var clock = Stopwatch.StartNew();
            for (var step = 0; step < seconds * rate; ++step) {
                contact.Fraction = step * 37 % 100 / 100.0;
                var due = (step + 1.0) / rate;
                Thread.Sleep(Math.Max(0, (int)(1000 * (due - clock.Elapsed.TotalSeconds)) - 1)); // it counts whole milliseconds
                while (clock.Elapsed.TotalSeconds < due) Thread.Yield();
                world.BeginStep(1.0 / rate, 9.81);
                if (step > rate / 2 && step % (rate * 15 / 100) == 0) {
                    Console.WriteLine(live.NowNs + (long)(contact.Fraction * 1e9 / rate));
                    world.Touch(contact);
                }
                world.EndStep();
                live.Follow(world);
            }
            for (var k = 0; door_onset(k) != 0; ++k) Console.WriteLine("- " + door_onset(k));
            var told = live.Status;
            Console.Error.WriteLine(string.Format(System.Globalization.CultureInfo.InvariantCulture, "L {0:0.0} ms, {1} played, {2} late, {3} xruns", live.LatencyNs * 1e-6, told.Played, told.Late, told.Xruns));
            door_leave();
        }
        return 0;
    }
}
