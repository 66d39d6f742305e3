/* SPDX-License-Identifier: MIT */
/* What the headers of Box2D 3 and Box3D share, whose functions are called alike: they include it with the
 * names that differ, and define what looks at vectors. */
PHYSVIB_UNUSED static double PHYSVIB_BOX(_gravity)(const PHYSVIB_BOX_STATE* haptics); /* m/s^2 */
PHYSVIB_UNUSED static void PHYSVIB_BOX(_before)(PHYSVIB_BOX_STATE* haptics, PHYSVIB_BOX(_number) * number,
                                                double seconds);
PHYSVIB_UNUSED static void PHYSVIB_BOX(_after)(PHYSVIB_BOX_STATE* haptics,
                                               const PHYSVIB_B(BodyEvents) * moved);
PHYSVIB_UNUSED static void PHYSVIB_BOX(_stop)(const PHYSVIB_BOX_STATE* haptics, PHYSVIB_BOX(_number) * number,
                                              double seconds);
PHYSVIB_UNUSED static void PHYSVIB_BOX(_contact)(PHYSVIB_BOX_STATE* haptics,
                                                 const PHYSVIB_B(ContactData) * found, double seconds);

/* An error of this step; `number`: the body that made it, or NULL. What was not told before comes first. */
PHYSVIB_UNUSED static void PHYSVIB_BOX(_fail)(PHYSVIB_BOX_STATE* haptics, PHYSVIB_BOX(_number) * number,
                                              int code, const char* line) {
    const int is_new = !number || !number->is_told;
    if (code >= 0 || haptics->is_new || (haptics->code != PHYSVIB_OK && !is_new)) return;
    haptics->code = code, haptics->is_new = is_new;
    if (number) number->is_told = 1;
    if (!number)
        snprintf(haptics->error, sizeof haptics->error, "%s", line);
    else
        snprintf(haptics->error, sizeof haptics->error, "%sbody %d: %s",
                 number->id < 0 ? PHYSVIB_BOX_NAME "'s " : "",
                 number->id < 0 ? number->body.index1 : number->id, line);
}

/* The number of a body, -1 if it has none. The body's user data are not used. */
PHYSVIB_UNUSED static int PHYSVIB_BOX(_id)(const PHYSVIB_BOX_STATE* haptics, PHYSVIB_B(BodyId) body) {
    if (body.index1 >= haptics->capacity || !PHYSVIB_B_EQUALS(haptics->numbers[body.index1].body, body))
        return -1;
    return haptics->numbers[body.index1].id;
}

/* The entry of a body, new if it has none; NULL: no memory. */
PHYSVIB_UNUSED static PHYSVIB_BOX(_number) *
    PHYSVIB_BOX(_entry)(PHYSVIB_BOX_STATE* haptics, PHYSVIB_B(BodyId) body) {
    PHYSVIB_BOX(_number)* numbers = haptics->numbers;
    if (body.index1 >= haptics->capacity) {
        const int capacity = 2 * body.index1 + 64;
        numbers = (PHYSVIB_BOX(_number)*)realloc(numbers, (size_t)capacity * sizeof *numbers);
        if (!numbers) return NULL;
        memset(numbers + haptics->capacity, 0, (size_t)(capacity - haptics->capacity) * sizeof *numbers);
        haptics->numbers = numbers, haptics->capacity = capacity;
    }
    numbers += body.index1;
    if (!PHYSVIB_B_EQUALS(numbers->body, body)) { /* perhaps the index of one that was destroyed */
        memset(numbers, 0, sizeof *numbers);
        numbers->body = body, numbers->id = -1;
    }
    return numbers;
}

/* Sets a body's values (from physvib_body_init); mass, inertia and gravity scale are the engine's of the
 * step. */
PHYSVIB_UNUSED static int PHYSVIB_BOX(_set)(PHYSVIB_BOX_STATE* haptics, PHYSVIB_B(BodyId) body, int id,
                                            physvib_body values) {
    const int falls = PHYSVIB_B(Body_GetType)(body) == PHYSVIB_B(_dynamicBody);
    PHYSVIB_BOX(_number) * number;
    int code;
    values.mass_kg = falls ? PHYSVIB_B(Body_GetMass)(body) : 0;
    values.inertia_kg_m2 = falls ? PHYSVIB_BOX_INERTIA(body) : 0;
    values.gravity_scale = PHYSVIB_B(Body_GetGravityScale)(body);
    code = physvib_world_set_body(haptics->world, id, &values);
    if (code != PHYSVIB_OK) return code;
    number = PHYSVIB_BOX(_entry)(haptics, body);
    if (!number) return PHYSVIB_ERROR_MEMORY;
    number->id = id, number->is_told = 0, number->values = values;
    return PHYSVIB_OK;
}

/* Call at the end; `world` is the caller's. */
PHYSVIB_UNUSED static void PHYSVIB_BOX(_free)(PHYSVIB_BOX_STATE* haptics) {
    free(haptics->numbers), free(haptics->found);
    haptics->numbers = NULL, haptics->capacity = 0;
    haptics->found = NULL, haptics->found_capacity = 0;
}

/* Call before b2DestroyBody or b3DestroyBody. */
PHYSVIB_UNUSED static int PHYSVIB_BOX(_remove)(PHYSVIB_BOX_STATE* haptics, PHYSVIB_B(BodyId) body) {
    const int id = PHYSVIB_BOX(_id)(haptics, body);
    if (id < 0) return PHYSVIB_OK;
    haptics->numbers[body.index1].id = -1;
    return physvib_world_remove_body(haptics->world, id);
}

/* When a gap closes, in steps after the start of this one; below 0: in the step before. Sub-steps change the
 * velocity before they move a body: its path is faster by half a sub-step's gravity. They push up to a
 * sub-step before they meet: then it closes after this step. */
PHYSVIB_UNUSED static double PHYSVIB_BOX(_fraction)(const PHYSVIB_BOX_STATE* haptics, double gap,
                                                    double speed, double pull, double seconds) {
    const double start = fmax(0.5 * speed, speed + 0.5 * pull * haptics->sub_step_s),
                 root = fmax(0, start * start + 2 * pull * gap),
                 length = gap < 0 ? haptics->last_step_s : seconds;
    return length > 0 ? fmin(2, fmax(-1, 2 * gap / (start + sqrt(root)) / length)) : 0;
}

/* An awake body's contacts: each once, with its second body, or the first if that is static or asleep. */
PHYSVIB_UNUSED static void PHYSVIB_BOX(_body)(PHYSVIB_BOX_STATE* haptics, PHYSVIB_B(BodyId) body,
                                              double seconds) {
    const int most = PHYSVIB_B(Body_GetContactCapacity)(body);
    PHYSVIB_B(ContactData)* found = haptics->found;
    int count, i;
    if (most > haptics->found_capacity) {
        found = (PHYSVIB_B(ContactData)*)realloc(found, 2 * (size_t)most * sizeof *found);
        if (!found) {
            PHYSVIB_BOX(_fail)(haptics, NULL, PHYSVIB_ERROR_MEMORY, "contacts: expected memory for them");
            return;
        }
        haptics->found = found, haptics->found_capacity = 2 * most;
    }
    count = PHYSVIB_B(Body_GetContactData)(body, found, most);
    for (i = 0; i < count; ++i) {
        const PHYSVIB_B(BodyId) a = PHYSVIB_B(Shape_GetBody)(found[i].shapeIdA),
                                b = PHYSVIB_B(Shape_GetBody)(found[i].shapeIdB);
        const int is_second = PHYSVIB_B_EQUALS(b, body),
                  rests = PHYSVIB_B(Body_GetType)(b) == PHYSVIB_B(_staticBody) || !PHYSVIB_B(Body_IsAwake)(b);
        if (!is_second && !(PHYSVIB_B_EQUALS(a, body) && rests)) continue;
        PHYSVIB_BOX(_contact)(haptics, &found[i], seconds);
    }
}

/* Call instead of b2World_Step or b3World_Step. Returns PHYSVIB_OK, or an error that no step before has
 * returned: that of a body is told once. haptics->code and haptics->error last as long as the error does. */
PHYSVIB_UNUSED static int PHYSVIB_BOX(_step)(PHYSVIB_BOX_STATE* haptics, double seconds, int sub_steps) {
    PHYSVIB_B(BodyEvents) moved;
    int i;
    haptics->code = PHYSVIB_OK, haptics->is_new = 0, haptics->error[0] = 0;
    haptics->sub_step_s = seconds / (sub_steps > 0 ? sub_steps : 1);
    PHYSVIB_BOX(_fail)
    (haptics, NULL, physvib_world_begin_step(haptics->world, seconds, PHYSVIB_BOX(_gravity)(haptics)),
     physvib_error());
    for (i = 1; i < haptics->capacity; ++i) {
        const PHYSVIB_B(BodyId) body = haptics->numbers[i].body;
        if (body.index1 && haptics->numbers[i].id >= 0 && PHYSVIB_B(Body_IsValid)(body) &&
            PHYSVIB_B(Body_GetType)(body) != PHYSVIB_B(_staticBody) && PHYSVIB_B(Body_IsAwake)(body))
            PHYSVIB_BOX(_before)(haptics, &haptics->numbers[i], seconds);
    }
    PHYSVIB_B(World_Step)(PHYSVIB_BOX_WORLD(haptics), (float)seconds, sub_steps);
    moved = PHYSVIB_B(World_GetBodyEvents)(PHYSVIB_BOX_WORLD(haptics));
    PHYSVIB_BOX(_after)(haptics, &moved);
    for (i = 0; i < moved.moveCount; ++i) PHYSVIB_BOX(_body)(haptics, moved.moveEvents[i].bodyId, seconds);
    for (i = 0; i < moved.moveCount; ++i) /* for the next step's contacts */
        if (PHYSVIB_BOX(_id)(haptics, moved.moveEvents[i].bodyId) >= 0)
            PHYSVIB_BOX(_stop)(haptics, &haptics->numbers[moved.moveEvents[i].bodyId.index1], seconds);
    haptics->last_step_s = seconds;
    PHYSVIB_BOX(_fail)(haptics, NULL, physvib_world_end_step(haptics->world), physvib_error());
    return haptics->is_new ? haptics->code : PHYSVIB_OK;
}

PHYSVIB_UNUSED static int PHYSVIB_BOX(_may_touch)(PHYSVIB_B(Filter) a, PHYSVIB_B(Filter) b) {
    if (a.groupIndex == b.groupIndex && a.groupIndex != 0) return a.groupIndex > 0;
    return (a.maskBits & b.categoryBits) != 0 && (a.categoryBits & b.maskBits) != 0;
}

#define PHYSVIB_BOX_SHAPES 32 /* of a body that an explanation looks at; the others are left out */

/* True if a filter keeps the body from all others that have numbers. */
PHYSVIB_UNUSED static int PHYSVIB_BOX(_is_filtered)(const PHYSVIB_BOX_STATE* haptics,
                                                    PHYSVIB_B(BodyId) body) {
    PHYSVIB_B(ShapeId) own[PHYSVIB_BOX_SHAPES], theirs[PHYSVIB_BOX_SHAPES];
    const int count = PHYSVIB_B(Body_GetShapes)(body, own, PHYSVIB_BOX_SHAPES);
    int has_others = 0, i, a, b;
    for (i = 1; i < haptics->capacity; ++i) {
        const PHYSVIB_B(BodyId) other = haptics->numbers[i].body;
        int others;
        if (!other.index1 || haptics->numbers[i].id < 0 || PHYSVIB_B_EQUALS(other, body) ||
            !PHYSVIB_B(Body_IsValid)(other))
            continue;
        others = PHYSVIB_B(Body_GetShapes)(other, theirs, PHYSVIB_BOX_SHAPES);
        for (a = 0; a < count; ++a)
            for (b = 0; b < others; ++b, has_others = 1)
                if (PHYSVIB_BOX(_may_touch)(PHYSVIB_B(Shape_GetFilter)(own[a]),
                                            PHYSVIB_B(Shape_GetFilter)(theirs[b])))
                    return 0;
    }
    return has_others;
}

/* PHYSVIB_NOTE_..., or -1. */
PHYSVIB_UNUSED static int PHYSVIB_BOX(_note)(const PHYSVIB_BOX_STATE* haptics, PHYSVIB_B(BodyId) body) {
    PHYSVIB_B(ShapeId) shapes[PHYSVIB_BOX_SHAPES];
    const int count = PHYSVIB_B(Body_GetShapes)(body, shapes, PHYSVIB_BOX_SHAPES);
    int sensors = 0, i;
    if (!PHYSVIB_B(Body_IsEnabled)(body)) return PHYSVIB_NOTE_DISABLED;
    for (i = 0; i < count; ++i) sensors += PHYSVIB_B(Shape_IsSensor)(shapes[i]) ? 1 : 0;
    if (count > 0 && sensors == count) return PHYSVIB_NOTE_SENSOR;
    if (PHYSVIB_BOX(_is_filtered)(haptics, body)) return PHYSVIB_NOTE_FILTERED;
    return PHYSVIB_B(Body_GetType)(body) != PHYSVIB_B(_staticBody) && !PHYSVIB_B(Body_IsAwake)(body)
               ? PHYSVIB_NOTE_ASLEEP
               : -1;
}

/* Writes to `text` why nothing is felt since the last call: an error of this header, or what
 * physvib_world_explain says after a look at all numbered bodies. */
PHYSVIB_UNUSED static void PHYSVIB_BOX(_explain)(const PHYSVIB_BOX_STATE* haptics, char* text, size_t size) {
    int i, note;
    if (size == 0) return;
    if (haptics->code != PHYSVIB_OK) {
        strncpy(text, haptics->error, size - 1), text[size - 1] = 0;
        return;
    }
    for (i = 1; i < haptics->capacity; ++i) {
        const PHYSVIB_B(BodyId) body = haptics->numbers[i].body;
        if (!body.index1 || !PHYSVIB_B(Body_IsValid)(body)) continue;
        if (haptics->numbers[i].id < 0 && haptics->numbers[i].is_told) {
            snprintf(text, size, PHYSVIB_BOX_NAME "'s body %d is not felt: give it a number.", body.index1);
            return;
        }
        if (haptics->numbers[i].id < 0) continue;
        note = PHYSVIB_BOX(_note)(haptics, body);
        if (note >= 0) physvib_world_note(haptics->world, haptics->numbers[i].id, note);
    }
    physvib_world_explain(haptics->world, text, size);
}
