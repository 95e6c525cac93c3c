// SPDX-License-Identifier: MIT
// The formulas behind the table of order parameters, which says what each means. NaN where fewer individuals are there, or move, than the
// quantity needs.
#pragma once

#include "libeval/group/moment.h"

namespace swarmfit::order_formulas {

double individuals(const Moment&);
double polarisation(const Moment&);
double milling(const Moment&);
double net_rotation(const Moment&);
double rotation(const Moment&);
double speed(const Moment&);
double group_speed(const Moment&);
double angular_speed(const Moment&);
double extent(const Moment&);
double median_radius(const Moment&);
double elongation(const Moment&);
double axis_ratio(const Moment&);
double axis_turn(const Moment&);
double core(const Moment&);
double halves(const Moment&);
double nearest(const Moment&);
double nearest_cv(const Moment&);
double nearest_ratio(const Moment&);
double parts(const Moment&);
double largest(const Moment&);
double mixing(const Moment&);
double ahead(const Moment&);
double abreast(const Moment&);
double lanes(const Moment&);
double radial_force(const Moment&);

}  // namespace swarmfit::order_formulas
