// SPDX-License-Identifier: MIT
// A ball of 0.2 kg falls from 0.8 m onto a floor in Farseer 3.5 and bounces three times: each hit's time and impulse, beside those on paper. What a game
// of yours needs is Feel.
using System;
using FarseerPhysics.Common;
using FarseerPhysics.Factories;
using Microsoft.Xna.Framework;
using PhysVib;
using Engine = FarseerPhysics.Dynamics;

/// <summary>Bodies are numbered from 0 by their UserData. Step in place of World.Step.</summary>
sealed class Feel {
    readonly Engine.World engine;
    readonly World haptics;

    public Feel(Engine.World engine, World haptics) {
        this.engine = engine;
        this.haptics = haptics;
        engine.ContactManager.PreSolve += (Engine.Contacts.Contact contact, ref FarseerPhysics.Collision.Manifold _) => {
            foreach (var body in new[] { contact.FixtureA.Body, contact.FixtureB.Body })
                haptics.Move((int)body.UserData, body.WorldCenter.X, body.WorldCenter.Y, body.LinearVelocity.X, body.LinearVelocity.Y, body.AngularVelocity);
        };
        engine.ContactManager.PostSolve += Push;
    }

    // With what gravity gave in this step, m g dt: 2 % of the third hit.
    void Push(Engine.Contacts.Contact contact, Engine.Contacts.ContactVelocityConstraint solved) {
        Vector2 normal;
        FixedArray2<Vector2> at;
        contact.GetWorldManifold(out normal, out at);
        for (int i = 0; i < solved.pointCount; ++i) {
            var told = Contact.Create((int)contact.FixtureA.Body.UserData, (int)contact.FixtureB.Body.UserData);
            told.X_m = at[i].X;
            told.Y_m = at[i].Y;
            told.NormalX = solved.normal.X;
            told.NormalY = solved.normal.Y;
            told.Impulse_Ns = solved.points[i].normalImpulse;
            told.Restitution = contact.Restitution;
            told.PointId = i;
            haptics.Touch(told);
        }
    }

    public void Step(float seconds) {
        haptics.BeginStep(seconds, engine.Gravity.Length());
        engine.Step(seconds);
        haptics.EndStep();
    }
}

static class Falls {
    static int Main() {
        const double g = 9.81, e = 0.6, height = 0.8, massKg = 0.2, radius = 0.05;
        const float dt = 0.005f;
        var engine = new Engine.World(new Vector2(0, -(float)g));
        var floor = BodyFactory.CreateRectangle(engine, 4f, 0.2f, 1f, new Vector2(0f, -0.1f), userData: 0);
        var ball = BodyFactory.CreateCircle(engine, (float)radius, (float)(massKg / (Math.PI * radius * radius)), new Vector2(0f, (float)(height + radius)), Engine.BodyType.Dynamic, 1);
        floor.Restitution = 0f;
        ball.Restitution = (float)e;
        var events = new Event[100];
        int count;
        using (var world = new World()) {
            var body = Body.Create();
            world.SetBody(0, body); // the floor: no mass, so nothing moves it
            body.MassKg = ball.Mass;
            body.IsCamera = 1; // it feels
            body.FrequencyHz = 200.0;
            body.DecayPerS = 30.0;
            world.SetBody(1, body);
            var feel = new Feel(engine, world);
            for (int step = 0; step < 320; ++step) feel.Step(dt);
            count = world.Take(events, true);
        }
        bool isRight = count >= 3;
        double speed = Math.Sqrt(2 * g * height), at = speed / g;
        for (int hit = 0; hit < Math.Min(3, count); ++hit) {
            double impulse = massKg * speed * (1 + e), late = events[hit].TimeNs * 1e-9 - at, strong = events[hit].Impulse_Ns / impulse - 1;
            Console.WriteLine("hit {0}: {1:F1} ms late, {2:F1} % too strong", hit + 1, 1000 * late, 100 * strong);
            isRight &= Math.Abs(late) < 2 * (hit + 1) * dt && Math.Abs(strong) < 0.05;
            speed *= e;
            at += 2 * speed / g;
        }
        return isRight ? 0 : 1;
    }
}
