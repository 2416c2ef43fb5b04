// A channel that cools a steel core: two materials, an inlet, an outlet, walls and a pipe across. Lengths in cm.
SetFactory("OpenCASCADE");

Rectangle(1) = {0, 0, 0, 20, 10};
Rectangle(2) = {13, 2, 0, 4, 5, 0.8};
Disk(3) = {6, 5, 0, 2};
BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{3}; Delete; };
BooleanFragments{ Surface{4}; Delete; }{ Surface{2}; Delete; }

inlet() = Curve In BoundingBox {-0.1, -0.1, -0.1, 0.1, 10.1, 0.1};
outlet() = Curve In BoundingBox {19.9, -0.1, -0.1, 20.1, 10.1, 0.1};
bottom() = Curve In BoundingBox {-0.1, -0.1, -0.1, 20.1, 0.1, 0.1};
top() = Curve In BoundingBox {-0.1, 9.9, -0.1, 20.1, 10.1, 0.1};
pipe() = Curve In BoundingBox {3.9, 2.9, -0.1, 8.1, 7.1, 0.1};
core() = Surface In BoundingBox {12.9, 1.9, -0.1, 17.1, 7.1, 0.1};
all() = Surface{:};

Physical Curve("inlet", 1) = inlet();
Physical Curve("outlet", 2) = outlet();
Physical Curve("walls", 3) = {bottom(), top()};
Physical Curve("pipe", 4) = pipe();
Physical Surface("water", 7) = all();
Physical Surface("steel core", 9) = core();
Physical Surface("water", 7) -= core();

MeshSize {:} = 0.9;
MeshSize { PointsOf{ Curve{pipe()}; } } = 0.4;
Mesh.Smoothing = 0;
Mesh.Optimize = 0;
