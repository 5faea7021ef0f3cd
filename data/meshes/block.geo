// A box 3 x 1 x 1 in two regions: the source of block_*.msh.
// Options set by -setnumber: kind = 0 tets, 1 hexes, 2 wedges; order = 1 or 2.
DefineConstant[kind = 0, order = 1];
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {3, 0, 0};
Point(4) = {0, 1, 0}; Point(5) = {1, 1, 0}; Point(6) = {3, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {4, 5}; Line(4) = {5, 6};
Line(5) = {1, 4}; Line(6) = {2, 5}; Line(7) = {3, 6};
Curve Loop(1) = {1, 6, -3, -5}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 7, -4, -6}; Plane Surface(2) = {2};
Transfinite Curve {1, 3} = 3; Transfinite Curve {2, 4} = 4; Transfinite Curve {5, 6, 7} = 3;
Transfinite Surface {1, 2};
If (kind == 1)
  Recombine Surface {1, 2};
EndIf
If (kind == 0)
  a[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; };
  b[] = Extrude {0, 0, 1} { Surface{2}; Layers{2}; };
Else
  a[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; Recombine; };
  b[] = Extrude {0, 0, 1} { Surface{2}; Layers{2}; Recombine; };
EndIf
Physical Volume("near") = {a[1]};
Physical Volume("far") = {b[1]};
Physical Surface("inlet") = {a[5]};
Physical Surface("outlet") = {b[3]};
Physical Surface("inside") = {a[3]};
Mesh.ElementOrder = order;
