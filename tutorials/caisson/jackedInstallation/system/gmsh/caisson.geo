// Triangles for a caisson of 5 m diameter: a slab one cell thick in the plane r = x, z, made into a wedge by
// extrudeMesh (system/extrudeMeshDict). The wall, its tip and the surface of the soil are lines of the mesh.
// Lengths in m. Other cells per wall: gmsh -setnumber cellsPerWall 4.

DefineConstant[ cellsPerWall = 2 ];

radius = 15;    // of the domain
bottom = -20;
top = 1;        // room for heave
Ri = 2.45;      // wall
Ro = 2.50;
tip = -0.5;     // initial level, as in constant/bodies

h = (Ro - Ri)/cellsPerWall;
fine = 0.15;    // distance from the wall that has cells of size h ...
growth = 1.1;   // ... and growth of the cells beyond it
largest = 1.5;

// Points along each horizontal line, from the axis outwards
Point(1)  = {0, 0, bottom};     Point(2)  = {radius, 0, bottom};
Point(3)  = {Ri, 0, tip};       Point(4)  = {Ro, 0, tip};
Point(5)  = {0, 0, 0};          Point(6)  = {Ri, 0, 0};     Point(7)  = {Ro, 0, 0};     Point(8)  = {radius, 0, 0};
Point(9)  = {0, 0, top};        Point(10) = {Ri, 0, top};   Point(11) = {Ro, 0, top};   Point(12) = {radius, 0, top};

Line(1) = {1, 2};               // bottom
Line(2) = {3, 4};               // tip
Line(3) = {5, 6};               // surface of the soil
Line(4) = {6, 7};
Line(5) = {7, 8};
Line(6) = {9, 10};              // top
Line(7) = {10, 11};
Line(8) = {11, 12};
Line(9)  = {1, 5};              // axis
Line(10) = {5, 9};
Line(11) = {3, 6};              // inner face of the wall
Line(12) = {6, 10};
Line(13) = {4, 7};              // outer face of the wall
Line(14) = {7, 11};
Line(15) = {2, 8};              // outer boundary
Line(16) = {8, 12};

Curve Loop(1) = {1, 15, -5, -13, -2, 11, -3, -9};  Plane Surface(1) = {1};  // soil
Curve Loop(2) = {2, 13, -4, -11};                  Plane Surface(2) = {2};  // inside the wall
Curve Loop(3) = {3, 12, -6, -10};                  Plane Surface(3) = {3};  // above the soil
Curve Loop(4) = {4, 14, -7, -12};                  Plane Surface(4) = {4};
Curve Loop(5) = {5, 16, -8, -14};                  Plane Surface(5) = {5};

Field[1] = Distance;
Field[1].CurvesList = {2, 11, 13};
Field[1].NumPointsPerCurve = 200;
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].DistMin = fine;
Field[2].SizeMin = h;
Field[2].SizeMax = largest;
Field[2].DistMax = fine + (largest - h)/(growth - 1);
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;

slab1[] = Extrude {0, 0.1, 0} { Surface{1}; Layers{1}; Recombine; };
slab2[] = Extrude {0, 0.1, 0} { Surface{2}; Layers{1}; Recombine; };
slab3[] = Extrude {0, 0.1, 0} { Surface{3}; Layers{1}; Recombine; };
slab4[] = Extrude {0, 0.1, 0} { Surface{4}; Layers{1}; Recombine; };
slab5[] = Extrude {0, 0.1, 0} { Surface{5}; Layers{1}; Recombine; };

// An extrusion returns its far side, its volume, then the sides in the order of the curve loop.
Physical Volume("soil") = {slab1[1], slab2[1], slab3[1], slab4[1], slab5[1]};
Physical Surface("front") = {1, 2, 3, 4, 5};
Physical Surface("back") = {slab1[0], slab2[0], slab3[0], slab4[0], slab5[0]};
Physical Surface("bottom") = {slab1[2]};
Physical Surface("outer") = {slab1[3], slab5[3]};
Physical Surface("axis") = {slab1[9], slab3[5]};
Physical Surface("top") = {slab3[4], slab4[4], slab5[4]};
