// SPDX-License-Identifier: MIT
// A ball of 0.2 kg falls from 0.8 m onto a floor, bounces and comes to rest: drop.wav, three seconds, four channels.
using System;
using PhysVib;

static class Drop {
    static void Main() {
        const double g = 9.81, dt = 0.01, e = 0.6;
        double height = 0.8, speed = -0.5 * g * dt; // between two steps
        var how = WorldSettings.Create();
        how.FullScaleImpulse_Ns = WorldSettings.Automatic; // the hardest usual hit: half of full scale
        var events = new Event[100];
        int count;
        using (var world = new World(how)) {
            var body = Body.Create();
            world.SetBody(0, body); // the floor: no mass, so nothing moves it
            body.MassKg = 0.2;
            body.IsCamera = 1; // it feels
            body.FrequencyHz = 200.0;
            body.DecayPerS = 30.0;
            world.SetBody(1, body);
            var contact = Contact.Create(0, 1);
            contact.Restitution = e;
            contact.X_m = 0.3;
            for (int step = 0; step < 300; ++step) { // your engine does this
                speed += g * dt;
                world.BeginStep(dt, g);
                if (height < speed * dt) {
                    contact.ApproachMPerS = speed;
                    contact.Gap_m = height;
                    world.Touch(contact);
                    if (speed > 0.3) speed = -e * speed;
                    else speed = height = 0.0; // it rests
                }
                world.EndStep();
                height -= speed * dt;
            }
            count = world.Take(events, true);
        }
        var settings = RendererSettings.Create(); // 48 kHz, four enchanters on the corners of a phone
        settings.FieldWidth_m = settings.FieldHeight_m = 1.0;
        Haptics.SaveWav("drop.wav", Haptics.Render(settings, events, count, 3 * 48000), 4, settings.RateHz);
        Console.WriteLine("{0} hits, the first at {1:F4} s: drop.wav", count, events[0].TimeNs * 1e-9);
    }
}
