#include "materialPoints/PointMerging.h"

namespace caisson {

void mergePoints(MaterialPoints& points, int stays, int goes, std::array<double, 2> poreVolume)
{
    const auto mean = [&](std::vector<double>& values, double ofStays, double ofGoes) {
        values[stays] = (ofStays * values[stays] + ofGoes * values[goes]) / (ofStays + ofGoes);
    };
    const auto byMass = [&](std::vector<double>& values) {
        mean(values, points.mass[stays], points.mass[goes]);
    };
    const auto byVolume = [&](std::vector<double>& values) {
        mean(values, points.volume[stays], points.volume[goes]);
    };
    for (std::vector<double>* values :
         {&points.r, &points.z, &points.vr, &points.vz, &points.initialR, &points.initialZ}) {
        byMass(*values);
    }
    if (points.affine()) {
        for (std::vector<double>& component : points.gradient) {
            byMass(component);
        }
    }
    for (std::vector<double>& component : points.stress) {
        byVolume(component);
    }
    for (std::vector<double>& variable : points.state) {
        byVolume(variable);
    }
    if (points.twoPhase()) {
        byVolume(points.porePressure);
        mean(points.wr, poreVolume[0], poreVolume[1]);
        mean(points.wz, poreVolume[0], poreVolume[1]);
    }
    points.mass[stays] += points.mass[goes];
    points.volume[stays] += points.volume[goes];
}

double mergingCost(const MaterialPoints& points, int one, int other, double width, double height)
{
    const double dr = (points.r[one] - points.r[other]) / width;
    const double dz = (points.z[one] - points.z[other]) / height;
    const double a = points.mass[one];
    const double b = points.mass[other];
    return a * b / (a + b) * (dr * dr + dz * dz);
}

} // namespace caisson
