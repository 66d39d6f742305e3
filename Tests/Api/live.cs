// SPDX-License-Identifier: MIT
// A landing through a device that plays for nobody, two worlds that keep their rhythms, and controllers, from C#; and how the library is called on other systems.
using System;
using PhysVib;

static class LiveFromCSharp {
    static int failures;
    static void Demand(bool isTrue, string what) {
        if (isTrue) return;
        Console.WriteLine("FAILED: " + what);
        ++failures;
    }
    static void Controllers() {
        using (var pads = new Pads(2, 1.0, 1.0))
        using (var world = new World()) {
            var hit = new Event { TimeNs = 1000000000, FrequencyHz = 200.0, DecayPerS = 30.0, Amplitude = 0.5, X_m = 1.0, Fixture = -1, Other = -1 };
            var motors = new Motors[2];
            pads.Strike(1, hit);
            Demand(pads.Send(0, world, 0) == 0, "an empty world");
            pads.Pull(hit.TimeNs, motors);
            Demand(motors[0].High == 0.0 && motors[1].High > 0.5, "the second controller is felt alone: " + motors[0].High + ", " + motors[1].High);
            pads.SetLevel(0.0);
            pads.Stop();
            pads.Pull(0, motors);
            Demand(motors[1].High == 0.0 && motors[1].Low == 0.0, "stopped");
        }
    }
    static int Main() {
        Demand(LibraryNames.Of("libphysvib.so.1", PlatformID.Win32NT, false)[0] == "libphysvib.dll", "Windows' name");
        Demand(LibraryNames.Of("libphysvib-live.so.1", PlatformID.Unix, true)[0] == "libphysvib-live.1.dylib", "macOS' name");
        Demand(LibraryNames.Of("libphysvib.so.1", PlatformID.Unix, false)[0] == "libphysvib.so.1", "Linux' name");
        var settings = LiveSettings.Create();
        settings.LongestGapS = 0.15;
        using (var live = new Live("None:no device", RendererSettings.Create(), settings))
        using (var world = new World()) {
            var body = Body.Create();
            world.SetBody(0, body);
            body.MassKg = 1.0;
            body.IsCamera = 1;
            body.FrequencyHz = 200.0;
            body.DecayPerS = 30.0;
            world.SetBody(1, body);
            int sent = 0;
            for (int step = 0; step < 20; ++step) {
                world.BeginStep(0.01, 9.81);
                if (step == 3) {
                    var contact = Contact.Create(0, 1);
                    contact.Impulse_Ns = 1.0;
                    world.Touch(contact);
                }
                world.EndStep();
                sent += live.Follow(world);
                System.Threading.Thread.Sleep(10);
            }
            live.Impact(0.0, 0.0, 0.5);
            live.Impact(0.0, 0.0, 0.5, material: "wooden board");
            live.SetGain(0, 0.5);
            live.SetMute(1, true);
            live.SetLayout(RendererSettings.Create());
            live.Silence(false);
            for (int wait = 0; wait < 500 && live.Status.Played < 3; ++wait) System.Threading.Thread.Sleep(10);
            var status = live.Status;
            Demand(sent == 1 && status.Played == 3 && status.Trouble == "", "one strike and two impacts are played: " + sent + " sent, " + status.Played + " played, " + status.Trouble);
            Demand(live.LatencyNs > 0 && live.NowNs > 0, "times");
            using (World early = new World(), late = new World()) {
                live.Follow(early);
                long start = live.StartNs(early);
                System.Threading.Thread.Sleep(400);
                live.Follow(late);
                early.BeginStep(0.4, 9.81);
                early.EndStep();
                live.Follow(early);
                Demand(live.StartNs(early) == start && live.StartNs(late) > start + 300000000, "each world keeps its start");
            }
            string refusal = "";
            try { live.SetLevel(7.0); } catch (PhysVibException error) { refusal = error.Message; }
            Demand(refusal == "level: expected -90 to 0 dB", "a refusal: " + refusal);
            try { live.Impact(0.0, 0.0, 0.5, "jam"); } catch (PhysVibException error) { refusal = error.Message; }
            Demand(refusal.StartsWith("material: expected one that vibrates (concrete block, ") && refusal.EndsWith(", found \"jam\""), "a refusal: " + refusal);
            body.SetMaterial("steel plate");
            Demand(body.FrequencyHz == 430.0 && body.MassKg == 1.0 && Body.Materials.Length >= 3, "a material");
            Demand(Event.Impact(0.1, 0.2, 0.3, "wooden board").Sound == Event.SoundOf("wooden board"), "an event of a material");
        }
        Controllers();
        return failures;
    }
}
