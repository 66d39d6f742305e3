// SPDX-License-Identifier: MIT
// Parts of the world panel that pictures and movies share.
#pragma once
#include "Pictures/PictureParts.h"

namespace physvib::picture {

/// Metres of the field, origin lower left, to pixels.
struct FieldMap {
    Box field;
    double pixelsPerMetre;
    Spot at(double xMetres, double yMetres) const {
        return {field.x + length(xMetres), field.bottom() - length(yMetres)};
    }
    float length(double metres) const { return static_cast<float>(metres * pixelsPerMetre); }
};

/// The field to scale, in the middle of `room`.
FieldMap fitField(const PictureInput& input, Area room);

/// A place of the field. Of a layout in space the view is oblique: what is nearer to the viewer is further
/// down and to the left.
Spot spotOf(const PictureInput& input, const FieldMap& map, double x, double y, double z);

/// Where actuator `channel` stands, the layout being mapped on the field.
Spot placeOf(const PictureInput& input, const FieldMap& map, int channel);

/// All bodies that are present, and the joints between them, at `input.poses`; nothing without a scene.
void drawBodies(const Canvas& canvas, const PictureInput& input, const FieldMap& map);

/// A badge per actuator, within `panel`.
void drawEnchanters(const Canvas& canvas, const PictureInput& input, const FieldMap& map, Area panel);

} // namespace physvib::picture
