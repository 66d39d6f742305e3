// SPDX-License-Identifier: MIT
// A landing through a device that plays for nobody, from C#; and how the library is called on other systems.
using System;
using PhysVib;

static class LiveFromCSharp {
    static int failures;
    static void Demand(bool isTrue, string what) {
        if (isTrue) return;
        Console.WriteLine("FAILED: " + what);
        ++failures;
    }
    static int Main() {
        Demand(LibraryNames.Of("libphysvib.so.0", PlatformID.Win32NT, false)[0] == "libphysvib.dll", "Windows' name");
        Demand(LibraryNames.Of("libphysvib-live.so.0", PlatformID.Unix, true)[0] == "libphysvib-live.0.dylib", "macOS' name");
        Demand(LibraryNames.Of("libphysvib.so.0", PlatformID.Unix, false)[0] == "libphysvib.so.0", "Linux' name");
        using (var live = new Live("None:no device"))
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
            string refusal = "";
            try { live.SetLevel(7.0); } catch (PhysVibException error) { refusal = error.Message; }
            Demand(refusal == "level: expected -90 to 0 dB", "a refusal: " + refusal);
            try { live.Impact(0.0, 0.0, 0.5, "jam"); } catch (PhysVibException error) { refusal = error.Message; }
            Demand(refusal.StartsWith("material: expected one that vibrates (concrete block, ") && refusal.EndsWith(", found \"jam\""), "a refusal: " + refusal);
            body.SetMaterial("steel plate");
            Demand(body.FrequencyHz == 430.0 && body.MassKg == 1.0 && Body.Materials.Length >= 3, "a material");
            Demand(Event.Impact(0.1, 0.2, 0.3, "wooden board").Sound == Event.SoundOf("wooden board"), "an event of a material");
        }
        return failures;
    }
}
