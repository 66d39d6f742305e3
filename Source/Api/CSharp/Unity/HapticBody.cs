// SPDX-License-Identifier: MIT
// Component for each Rigidbody2D in Unity that is a haptic source or strikes one: reports its contacts to HapticWorld. Untried in Unity; Docs/csharp.md says how to set it up.
using PhysVib;
using UnityEngine;

public class HapticBody : MonoBehaviour {
    public bool isFelt = true; // a haptic source
    public float frequencyHz = 200, decayPerS = 30, restitution = 0.3f;
    int id;
    Body values;
    Rigidbody2D of;

    void Awake() {
        of = GetComponent<Rigidbody2D>();
        id = HapticWorld.it.Next();
        values = Body.Create();
        values.MassKg = -1;
        values.IsCamera = isFelt ? 1 : 0;
        values.FrequencyHz = frequencyHz;
        values.DecayPerS = decayPerS;
        Weigh();
    }
    void Weigh() { // mass and type may change while a game runs
        var mass = of.bodyType == RigidbodyType2D.Dynamic ? of.mass : 0;
        if (values.MassKg == mass) return;
        values.MassKg = mass;
        HapticWorld.it.world.SetBody(id, values);
    }
    void OnDestroy() { HapticWorld.it.gone.Add(id); }
    void OnCollisionEnter2D(Collision2D now) { Tell(now, true); }
    void OnCollisionStay2D(Collision2D now) { Tell(now, false); }

    void Tell(Collision2D now, bool isNew) {
        var other = now.collider.GetComponentInParent<HapticBody>();
        if (other != null && other.id > id) return; // the other body reports this pair
        Weigh();
        if (other != null) other.Weigh();
        var point = now.GetContact(0);
        var contact = Contact.Create(id, other != null ? other.id : 0);
        contact.X_m = point.point.x;
        contact.Y_m = point.point.y;
        contact.NormalX = -point.normal.x; // Unity's normal points to this body
        contact.NormalY = -point.normal.y;
        contact.ApproachMPerS = isNew ? Mathf.Abs(Vector2.Dot(now.relativeVelocity, point.normal)) : 0;
        contact.Restitution = restitution;
        contact.Gap_m = point.separation;
        contact.GapFraction = 1; // contacts are reported after the step
        contact.PointId = Contact.ByPlace;
        HapticWorld.it.world.Touch(contact);
    }
}
