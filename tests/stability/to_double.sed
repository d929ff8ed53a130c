# The shaders' mathematics in double: types and literals, nothing else.
s/\bfloat\b/double/g
s/\bvec([234])\b/dvec\1/g
s/\bmat([34])\b/dmat\1/g
s/\bin_float\b/in_double/g
s/([0-9]\.[0-9]*(e[-+]?[0-9]+)?)f\b/\1/g
