// A channel 2 x 1 with a round hole: the source of channel_*.msh, written with
//   gmsh -2 channel.geo -format msh22|msh41 [-bin]
Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2, 1, 0}; Point(4) = {0, 1, 0};
Point(5) = {0.6, 0.5, 0}; Point(6) = {0.8, 0.5, 0}; Point(7) = {0.4, 0.5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Circle(5) = {6, 5, 7}; Circle(6) = {7, 5, 6};
Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {5, 6};
Plane Surface(1) = {1, 2};
Physical Surface("fluid") = {1};
Physical Curve("inlet side") = {4};
Physical Curve("outlet") = {2};
Physical Curve("walls") = {1, 3};
Physical Curve("hole") = {5, 6};
Mesh.MeshSizeMin = 0.25;
Mesh.MeshSizeMax = 0.25;
