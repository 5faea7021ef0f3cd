// A straight vessel of tetrahedra along z, the whole of it or a wedge from angle 0 on, fine within a band of z and
// towards the wall. Boundaries inlet, outlet, wall, and cut_0, cut_1 of a wedge. All numbers are set by -setnumber.
DefineConstant[
  radius = 1.4, z_inlet = -4, z_outlet = 14.2,
  angle = 60,                     // of the wedge in degrees; 360: all of it
  h = 0.3, h_band = 0.12,         // cells far from the band, and in it
  z_first = -0.5, z_last = 2.5,   // the band
  growth = 0.2,                   // of the cells per length beyond the band
  wall_ratio = 0.7                // cells at the wall over those at the axis
];
Point(1) = {0, 0, z_inlet};
n_arcs = angle < 360 ? 1 : 3; // an arc is shorter than half a circle
For k In {0 : n_arcs}
  phi = k * angle / n_arcs * Pi / 180;
  Point(2 + k) = {radius * Cos(phi), radius * Sin(phi), z_inlet};
EndFor
For k In {0 : n_arcs - 1}
  last = (angle < 360 || k < n_arcs - 1) ? 3 + k : 2;
  Circle(10 + k) = {2 + k, 1, last};
EndFor
If (angle < 360)
  Line(1) = {1, 2};
  Line(2) = {3, 1};
  Curve Loop(1) = {1, 10, 2};
Else
  Curve Loop(1) = {10, 11, 12};
EndIf
Plane Surface(1) = {1};
all[] = Extrude {0, 0, z_outlet - z_inlet} { Surface{1}; };
Physical Volume("fluid") = {all[1]};
Physical Surface("inlet") = {1};
Physical Surface("outlet") = {all[0]};
If (angle < 360)
  Physical Surface("cut_0") = {all[2]};
  Physical Surface("wall") = {all[3]};
  Physical Surface("cut_1") = {all[4]};
Else
  Physical Surface("wall") = {all[2], all[3], all[4]};
EndIf

// Distance from the band in z, then what the wall makes of it.
Field[1] = MathEval;
Field[1].F = Sprintf("(%g + %g * 0.5 * (Abs((%g) - z) + (%g) - z + Abs(z - (%g)) + z - (%g))) * (1 - %g * ((x*x + y*y) / %g)^3)",
                     h_band, growth, z_first, z_first, z_last, z_last, 1 - wall_ratio, radius * radius);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = h;
Mesh.Optimize = 1;
Mesh.MshFileVersion = 4.1;
Mesh.Binary = 1;
General.NumThreads = 1; // the same mesh on every machine
