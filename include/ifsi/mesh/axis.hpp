#pragma once
/// \file
/// Divisions of an interval into cells: the increasing coordinates of the n + 1 cell ends.

#include <string>
#include <vector>

namespace ifsi {

using Axis = std::vector<double>;

/// Throws Error(configuration) unless there is a cell and the coordinates increase.
void check_increasing(const Axis& axis, const std::string& what);

/// n equal cells.
Axis uniform_axis(double lower, double upper, int n);

/// n cells growing geometrically; the last is `ratio` times as long as the first.
Axis geometric_axis(double lower, double upper, int n, double ratio);

/// n cells growing (or shrinking) geometrically from a first one of the given length.
Axis axis_from_first_cell(double lower, double upper, int n, double first);

/// n cells, symmetric about the middle; the middle ones are `ratio` times as long as the outermost.
Axis symmetric_axis(double lower, double upper, int n, double ratio);

/// Two neighbouring axes as one; the second begins where the first ends.
Axis join(Axis first, const Axis& second);

/// The axis reflected about x = 0: cell sizes in the opposite order.
Axis reflect(const Axis& axis);

/// The axis moved by an offset.
Axis shift(Axis axis, double offset);

}  // namespace ifsi
