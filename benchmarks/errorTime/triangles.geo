// A rectangle of triangles from (0 0) to (width height + 2 height/rows): for -setnumber width, height, columns, rows; with
// two more rows of room above where `above` is 1, two more columns beside where `beside` is 1. A slab along y.
DefineConstant[ width = 1, height = 1, columns = 4, rows = 4, above = 0, beside = 0 ];
w = width*(1 + beside*2/columns);
h = height*(1 + above*2/rows);
Point(1) = {0, 0, 0}; Point(2) = {w, 0, 0}; Point(3) = {w, 0, h}; Point(4) = {0, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Transfinite Curve {1, 3} = columns + 2*beside + 1;
Transfinite Curve {2, 4} = rows + 2*above + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface {1} Alternate;
slab[] = Extrude {0, 0.1, 0} { Surface{1}; Layers{1}; Recombine; };
Physical Volume("soil") = {slab[1]};
Physical Surface("front") = {1};
Physical Surface("back") = {slab[0]};
Physical Surface("bottom") = {slab[2]};
Physical Surface("outer") = {slab[3]};
Physical Surface("top") = {slab[4]};
Physical Surface("axis") = {slab[5]};
