# $accuracy
# y points down.

static func evaluate(curve: Dictionary, t: float) -> Vector2:
	var i := 0
	while i < curve.pieces.size() - 1 and t >= curve.ends[i + 1]:
		i += 1
	var s: float = (t - curve.ends[i]) / (curve.ends[i + 1] - curve.ends[i])
	var points: Array = curve.pieces[i] # control points; de Casteljau's scheme
	while points.size() > 1:
		var next := []
		for k in points.size() - 1:
			var a: Array = points[k]
			var b: Array = points[k + 1]
			next.append([(1 - s) * a[0] + s * b[0], (1 - s) * a[1] + s * b[1]])
		points = next
	return Vector2(points[0][0], points[0][1])
$each
# $title
const $data = {
	"ends": $ends,
	"pieces": [
		$pieces,
	],
}
static func $name(t: float) -> Vector2:
	return evaluate($data, t)
