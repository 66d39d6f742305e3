// SPDX-License-Identifier: MIT
// Worlds from which nothing is felt, each for one reason: the explanation names it, in C#'s words.
using System;
using PhysVib;

static class SilentWorlds {
    static int count;
    static void Expect(string said, string why) {
        ++count;
        if (!why.Contains(said)) throw new Exception("expected \"" + said + "\", found \"" + why + "\"");
    }

    // A floor (0) and a ball (1) that is a haptic source, hit once.
    static World Hit(Action<World> prepare = null, Func<Body, Body> ball = null, Func<Contact, Contact> contact = null) {
        var world = new World();
        var body = Body.Create();
        world.SetBody(0, body);
        body.MassKg = 2;
        body.IsCamera = 1;
        body.FrequencyHz = 200;
        body.DecayPerS = 30;
        world.SetBody(1, ball == null ? body : ball(body));
        if (prepare != null) prepare(world);
        var met = Contact.Create(1, 0);
        met.X_m = met.Y_m = 0.5;
        met.NormalY = -1;
        met.ApproachMPerS = 3;
        world.BeginStep(0.01, 9.81);
        world.Touch(contact == null ? met : contact(met));
        world.EndStep();
        return world;
    }

    static void Main() {
        Expect("(World.BeginStep and World.EndStep)", new World().Explain());
        Expect("set IsCamera", Hit(null, b => { b.IsCamera = 0; return b; }).Explain());
        Expect("set MassKg", Hit(null, b => { b.MassKg = 0; b.StaticMassKg = 2; return b; }).Explain());
        Expect("set FrequencyHz and DecayPerS", Hit(null, b => { b.FrequencyHz = b.DecayPerS = 0; return b; }).Explain());
        Expect("set ThresholdMPerS", Hit(null, null, c => { c.ApproachMPerS = 0.08; return c; }).Explain());
        Expect("set ApproachMPerS or Impulse_Ns, or call World.Move", Hit(null, null, c => { c.ApproachMPerS = -1e300; return c; }).Explain());
        Expect("set FieldWidth_m", Hit(null, null, c => { c.X_m = 3; return c; }).Explain());
        Expect("part along the reported normal", Hit(null, null, c => { c.ApproachMPerS = -3; return c; }).Explain());
        Expect("pixels", Hit(null, null, c => { c.X_m = 300; return c; }).Explain());
        var world = Hit();
        Expect("1 event was made", world.Explain());
        world.BeginStep(0.01, 9.81);
        world.EndStep();
        world.Note(1, Note.Sensor);
        Expect("body 1 is a sensor", world.Explain());
        var facts = OutputFacts.Create();
        facts.IsMissing = 1;
        Expect("No device plays the events", Hit().Explain(facts));
        using (var renderer = new Renderer(RendererSettings.Create())) Expect("No device plays the events (no samples", Hit().Explain(renderer));
        Console.WriteLine(count + " silent worlds are explained");
    }
}
