// $accuracy

function evaluate({ ends, pieces }, t) {
  let i = 0;
  while (i < pieces.length - 1 && t >= ends[i + 1]) i += 1;
  const s = (t - ends[i]) / (ends[i + 1] - ends[i]);
  let points = pieces[i]; // control points; de Casteljau's scheme
  while (points.length > 1) {
    points = points.slice(1).map(([x, y], k) => {
      return [(1 - s) * points[k][0] + s * x, (1 - s) * points[k][1] + s * y];
    });
  }
  return points[0];
}
$each
// $title
const $data = {
  ends: $ends,
  pieces: [
    $pieces,
  ],
};
export const $name = (t) => evaluate($data, t);
