// A channel 2 x 1 with a hole: the source of channel_*.msh.
//   for v in 2.2 4.1: gmsh -2 channel.geo -format msh22|msh41 [-bin] -o channel_22_ascii.msh
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 1};
Disk(2) = {0.6, 0.5, 0, 0.2, 0.2};
BooleanDifference(3) = {Surface{1}; Delete;}{Surface{2}; Delete;};
Physical Surface("fluid") = {3};
Physical Curve("inlet side") = {7};
Physical Curve("outlet") = {8};
Physical Curve("walls") = {6, 9};
Physical Curve("hole") = {5};
Mesh.MeshSizeMin = 0.25;
Mesh.MeshSizeMax = 0.25;
