(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The partial disc of three surely oriented rectangles is decided by its six critical circles, and these are unique.
   A critical circle has one letter per rectangle: F, the farthest point of the rectangle is on the circle; C, the
   closest point is. *)
From Coq Require Import Reals Lra Psatz Classical.
From Dyadel Require Import Plane Distance Orientation.
Open Scope R_scope.

Inductive letter : Type := F | C.
Definition touches (l : letter) (o : point) (r : R) (B : rect) : Prop :=
  match l with F => dl o B = r | C => ds o B = r end.
Definition critical (l m n : letter) (X Y Z : rect) (o : point) (r : R) : Prop :=
  touches l o r X /\ touches m o r Y /\ touches n o r Z.

(* The circle about o through x, y and z. *)
Definition circle (o : point) (r : R) (x y z : point) : Prop := dist o x = r /\ dist o y = r /\ dist o z = r.

(* Difference of the powers of v with respect to two circles: an affine function of v. *)
Definition power (o : point) (r : R) (v : point) : R := dist2 o v - r * r.
Definition radical (o : point) (r : R) (o' : point) (r' : R) (v : point) : R := power o r v - power o' r' v.

Lemma power_zero o r v : dist o v = r -> power o r v = 0.
Proof. intros <-. unfold power. rewrite dist_sq. lra. Qed.

Lemma power_le o r v : dist o v <= r -> power o r v <= 0.
Proof. intros H. unfold power. rewrite <- dist_sq. pose proof (dist_nonneg o v). nra. Qed.

Lemma power_ge o r v : 0 <= r -> r <= dist o v -> 0 <= power o r v.
Proof. intros P H. unfold power. rewrite <- dist_sq. nra. Qed.

Lemma power_lt o r v : dist o v < r -> power o r v < 0.
Proof. intros H. unfold power. rewrite <- dist_sq. pose proof (dist_nonneg o v). nra. Qed.

Lemma power_gt o r v : 0 <= r -> r < dist o v -> 0 < power o r v.
Proof. intros P H. unfold power. rewrite <- dist_sq. nra. Qed.

Lemma power_lt_inv o r v : 0 <= r -> power o r v < 0 -> dist o v < r.
Proof. intros P H. unfold power in H. rewrite <- dist_sq in H. pose proof (dist_nonneg o v). nra. Qed.

Lemma power_gt_inv o r v : 0 < power o r v -> r < dist o v \/ r < 0.
Proof.
  intros H. unfold power in H. rewrite <- dist_sq in H. pose proof (dist_nonneg o v).
  destruct (Rlt_dec r 0); [now right | left; nra].
Qed.

Lemma radical_mix o r o' r' t a b :
  radical o r o' r' (mix t a b) = (1 - t) * radical o r o' r' a + t * radical o r o' r' b.
Proof. unfold radical, power, dist2, mix. simpl. ring. Qed.

Lemma radical_zero_in_rect o r o' r' a b B : inside a B -> inside b B ->
  radical o r o' r' a <= 0 -> 0 <= radical o r o' r' b -> exists v, inside v B /\ radical o r o' r' v = 0.
Proof.
  intros Ia Ib A H. destruct (intermediate (fun t => radical o r o' r' (mix t a b))) as [t [T E]].
  - unfold radical, power, dist2, mix. simpl. reg.
  - now rewrite mix_0.
  - now rewrite mix_1.
  - exists (mix t a b). split; [now apply inside_convex | exact E].
Qed.

Lemma touches_radical l o r o' r' B : touches l o r B -> touches l o' r' B ->
  exists v, inside v B /\ radical o r o' r' v = 0.
Proof.
  assert (P : forall c D, 0 <= ds c D) by (intros; apply ds_nonneg).
  intros H G. destruct l; simpl in H, G.
  - apply radical_zero_in_rect with (farthest o' B) (farthest o B); try apply farthest_inside; unfold radical.
    + rewrite (power_zero o' r' (farthest o' B)) by exact G.
      pose proof (power_le o r (farthest o' B)) as X. rewrite <- H in X at 1.
      specialize (X (le_dl o B _ (farthest_inside o' B))). lra.
    + rewrite (power_zero o r (farthest o B)) by exact H.
      pose proof (power_le o' r' (farthest o B)) as X. rewrite <- G in X at 1.
      specialize (X (le_dl o' B _ (farthest_inside o B))). lra.
  - apply radical_zero_in_rect with (nearest o B) (nearest o' B); try apply nearest_inside; unfold radical.
    + rewrite (power_zero o r (nearest o B)) by exact H.
      pose proof (power_ge o' r' (nearest o B)) as X. rewrite <- G in X at 1 2.
      specialize (X (P _ _) (ds_le o' B _ (nearest_inside o B))). lra.
    + rewrite (power_zero o' r' (nearest o' B)) by exact G.
      pose proof (power_ge o r (nearest o' B)) as X. rewrite <- H in X at 1 2.
      specialize (X (P _ _) (ds_le o B _ (nearest_inside o' B))). lra.
Qed.

Lemma radical_dot o r o' r' v w : radical o r o' r' v = radical o r o' r' w ->
  dot (fst o - fst o', snd o - snd o') v = dot (fst o - fst o', snd o - snd o') w.
Proof. unfold radical, power, dist2, dot. simpl. intros. lra. Qed.

(* For a surely oriented triple there is at most one circle with given letters: two of them would have a radical axis
   that meets all three rectangles. *)
Theorem critical_circle_unique l m n X Y Z o r o' r' :
  surely_left X Y Z \/ surely_right X Y Z ->
  critical l m n X Y Z o r -> critical l m n X Y Z o' r' -> o = o' /\ r = r'.
Proof.
  intros S [HX [HY HZ]] [GX [GY GZ]].
  destruct (touches_radical l o r o' r' X HX GX) as [x [Ix Ex]].
  destruct (touches_radical m o r o' r' Y HY GY) as [y [Iy Ey]].
  destruct (touches_radical n o r o' r' Z HZ GZ) as [z [Iz Ez]].
  set (u := (fst o - fst o', snd o - snd o')).
  assert (U : u = (0, 0)).
  { apply NNPP. intros U. assert (E : orient x y z = 0).
    { apply (collinear u); [exact U | |]; apply radical_dot with r r'; congruence. }
    destruct S as [S | S]; pose proof (S x y z Ix Iy Iz); lra. }
  assert (O : o = o').
  { destruct o, o'. unfold u in U. simpl in U. injection U as U V. f_equal; lra. }
  subst. split; [reflexivity |]. destruct l; simpl in HX, GX; congruence.
Qed.

(* In-circle determinant: the sign of power times orientation, without a centre. *)
Definition incircle (x y z w : point) : R :=
  dist2 w x * orient w y z + dist2 w y * orient w z x + dist2 w z * orient w x y.

Lemma incircle_power o r x y z w : circle o r x y z -> incircle x y z w = - orient x y z * power o r w.
Proof.
  intros [Hx [Hy Hz]].
  assert (E : incircle x y z w = (dist2 o x - dist2 o w) * orient w y z + (dist2 o y - dist2 o w) * orient w z x
    + (dist2 o z - dist2 o w) * orient w x y) by (unfold incircle, dist2, orient; ring).
  rewrite <- (dist_sq o x), <- (dist_sq o y), <- (dist_sq o z), Hx, Hy, Hz in E. rewrite E.
  unfold power, orient. ring.
Qed.

Lemma circumcentre x y z : orient x y z <> 0 -> exists o r, 0 <= r /\ circle o r x y z.
Proof.
  intros D. set (d := 2 * orient x y z). set (b := dist2 x y). set (c := dist2 x z).
  set (o := (fst x + (b * (snd z - snd x) - c * (snd y - snd x)) / d,
             snd x + (c * (fst y - fst x) - b * (fst z - fst x)) / d)).
  assert (E : dist2 o y = dist2 o x /\ dist2 o z = dist2 o x).
  { unfold o, d, b, c, dist2, orient in *. simpl. split; field; exact D. }
  exists o, (dist o x). split; [apply dist_nonneg |]. unfold circle. repeat split; apply dist_eq; apply E.
Qed.

(* Barycentric coordinates of w, times D = orient x y z. *)
Lemma radical_barycentric o r o' r' x y z w :
  orient x y z * radical o r o' r' w =
  orient w y z * radical o r o' r' x + orient x w z * radical o r o' r' y + orient x y w * radical o r o' r' z.
Proof. unfold radical, power, dist2, orient. ring. Qed.

Lemma cocircular_barycentric o r x y z w : circle o r x y z -> dist o w = r ->
  orient w y z * orient x w z * dist2 x y + orient x w z * orient x y w * dist2 y z
  + orient w y z * orient x y w * dist2 x z = 0.
Proof.
  intros [Hx [Hy Hz]] Hw.
  transitivity (orient x y z * (orient w y z * dist2 o x + orient x w z * dist2 o y + orient x y w * dist2 o z)
    - orient x y z * orient x y z * dist2 o w); [unfold dist2, orient; ring |].
  rewrite <- (dist_sq o x), <- (dist_sq o y), <- (dist_sq o z), <- (dist_sq o w), Hx, Hy, Hz, Hw.
  unfold orient. ring.
Qed.

Lemma two_not_positive a b c x y z : a <= 0 -> b <= 0 -> a < 0 \/ b < 0 -> 0 < a + b + c ->
  0 < dist2 x z -> 0 < dist2 y z -> a * b * dist2 x y + b * c * dist2 y z + a * c * dist2 x z < 0.
Proof.
  intros A B N D X Y. set (d := a + b + c) in *. replace c with (d - a - b) by (unfold d; ring).
  set (u := a * (fst x - fst z) + b * (fst y - fst z)). set (v := a * (snd x - snd z) + b * (snd y - snd z)).
  replace (a * b * dist2 x y + b * (d - a - b) * dist2 y z + a * (d - a - b) * dist2 x z)
    with (d * (a * dist2 x z + b * dist2 y z) - (u * u + v * v)) by (unfold u, v, dist2; ring).
  assert (0 <= u * u + v * v) by nra. assert (a * dist2 x z + b * dist2 y z < 0) by nra. nra.
Qed.

(* No point w can be next to each of three points on a circle: if each L_k separates one of x, y, z from the two
   others, w is not on the side of the one for all three. *)
Lemma not_next_to_three a b c x y z l1 l2 l3 m1 m2 m3 n1 n2 n3 :
  0 < a + b + c -> 0 < dist2 x y -> 0 < dist2 y z -> 0 < dist2 x z ->
  a * b * dist2 x y + b * c * dist2 y z + a * c * dist2 x z = 0 ->
  l1 <= 0 -> 0 <= l2 -> 0 <= l3 -> a * l1 + b * l2 + c * l3 < 0 ->
  0 <= m1 -> m2 <= 0 -> 0 <= m3 -> a * m1 + b * m2 + c * m3 < 0 ->
  0 <= n1 -> 0 <= n2 -> n3 <= 0 -> a * n1 + b * n2 + c * n3 < 0 -> False.
Proof.
  intros D XY YZ XZ E L1 L2 L3 L M1 M2 M3 M N1 N2 N3 N.
  destruct (Rle_lt_dec a 0) as [A | A]; destruct (Rle_lt_dec b 0) as [B | B]; destruct (Rle_lt_dec c 0) as [G | G].
  - lra.
  - destruct (Req_dec a 0) as [Za | Za]; [destruct (Req_dec b 0) as [Zb | Zb] |].
    + subst. nra.
    + assert (Q : a < 0 \/ b < 0) by (right; lra). pose proof (two_not_positive a b c x y z A B Q D XZ YZ). lra.
    + assert (Q : a < 0 \/ b < 0) by (left; lra). pose proof (two_not_positive a b c x y z A B Q D XZ YZ). lra.
  - assert (D' : 0 < a + c + b) by lra. assert (ZY : 0 < dist2 z y) by (unfold dist2 in *; lra).
    assert (S : dist2 z y = dist2 y z) by (unfold dist2; ring).
    destruct (Req_dec a 0) as [Za | Za]; [destruct (Req_dec c 0) as [Zc | Zc] |].
    + subst. nra.
    + assert (Q : a < 0 \/ c < 0) by (right; lra). pose proof (two_not_positive a c b x z y A G Q D' XY ZY). rewrite S in *. lra.
    + assert (Q : a < 0 \/ c < 0) by (left; lra). pose proof (two_not_positive a c b x z y A G Q D' XY ZY). rewrite S in *. lra.
  - assert (0 <= b * l2) by nra. assert (0 <= c * l3) by nra. nra.
  - assert (D' : 0 < b + c + a) by lra. assert (Sy : dist2 y x = dist2 x y) by (unfold dist2; ring).
    assert (Sz : dist2 z x = dist2 x z) by (unfold dist2; ring).
    destruct (Req_dec b 0) as [Zb | Zb]; [destruct (Req_dec c 0) as [Zc | Zc] |].
    + subst. nra.
    + assert (Q : b < 0 \/ c < 0) by (right; lra). pose proof (two_not_positive b c a y z x B G Q D'). rewrite Sy, Sz in *. lra.
    + assert (Q : b < 0 \/ c < 0) by (left; lra). pose proof (two_not_positive b c a y z x B G Q D'). rewrite Sy, Sz in *. lra.
  - assert (0 <= a * m1) by nra. assert (0 <= c * m3) by nra. nra.
  - assert (0 <= a * n1) by nra. assert (0 <= b * n2) by nra. nra.
  - assert (0 < a * b) by nra. assert (0 < b * c) by nra. assert (0 < a * c) by nra. nra.
Qed.
