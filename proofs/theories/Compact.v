(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Possible pairs at the limit of a stream: a pair that is possible at every stage is possible at the limit, so an
   illegal pair is found to be illegal at some stage. Centres may run to infinity on the way; discs and half-planes
   together are compact. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Disc PartialDisc Crossing Bounds Limits.
Open Scope R_scope.

(* Q t e for all e small enough at each t, in a neighbourhood of t: then one e does for the whole interval. *)
Lemma uniform (Q : R -> R -> Prop) lo hi : (forall s d e, 0 < d <= e -> Q s e -> Q s d) ->
  (forall t, lo <= t <= hi -> exists e, 0 < e /\ forall s, Rabs (s - t) <= e -> Q s e) ->
  exists e, 0 < e /\ forall s, lo <= s <= hi -> Q s e.
Proof.
  intros Anti Loc. destruct (Rlt_dec hi lo) as [Em | Ne]; [exists 1; split; [lra |]; intros; lra |].
  set (E t := lo <= t <= hi /\ exists e, 0 < e /\ forall s, lo <= s <= t -> Q s e).
  assert (E0 : E lo).
  { split; [lra |]. destruct (Loc lo) as [e [P H]]; [lra |]. exists e. split; [exact P |]. intros s S. apply H.
    replace (s - lo) with 0 by lra. rewrite Rabs_R0. lra. }
  destruct (completeness E) as [m [Ub Lub]]; [exists hi; intros t [T _]; lra | now exists lo |].
  assert (M : lo <= m <= hi) by (split; [now apply Ub | apply Lub; intros t [T _]; lra]).
  destruct (Loc m M) as [e [P H]].
  assert (T : exists t, E t /\ m - e < t).
  { apply NNPP. intros N. assert (m <= m - e); [| lra]. apply Lub. intros t Et. apply Rnot_lt_le. intros L. apply N.
    now exists t. }
  destruct T as [t [[T [e' [P' H']]] L]].
  assert (K : forall h, t <= h -> h <= hi -> h <= m + e -> E h).
  { intros h Th Hh Hm. split; [lra |]. exists (Rmin e e'). pose proof (Rmin_l e e'). pose proof (Rmin_r e e').
    assert (0 < Rmin e e') by (now apply Rmin_pos). split; [assumption |]. intros s S.
    destruct (Rle_dec s t) as [A | A].
    - apply Anti with e'; [lra |]. apply H'. lra.
    - apply Anti with e; [lra |]. apply H. apply Rabs_le. lra. }
  pose proof (Ub t) as Ut. assert (Et : E t) by (split; [exact T | now exists e']). specialize (Ut Et).
  set (h := Rmin hi (m + e)). pose proof (Rmin_l hi (m + e)) as Hl. pose proof (Rmin_r hi (m + e)) as Hr.
  fold h in Hl, Hr. assert (Hm : m <= h) by (apply Rmin_glb; lra).
  assert (Eh : E h) by (apply K; lra). pose proof (Ub h Eh).
  assert (hi <= m + e). { apply Rnot_lt_le. intros X. assert (h = m + e) by (unfold h; apply Rmin_right; lra). lra. }
  destruct (K hi) as [_ [d [D G]]]; [lra | lra | lra |]. now exists d.
Qed.

(* The same for a rectangle, with room round it. *)
Lemma uniform_rect (Q : point -> R -> Prop) (Y : rect) : (forall z d e, 0 < d <= e -> Q z e -> Q z d) ->
  (forall z, inside z Y -> exists e, 0 < e /\ forall w, Rabs (fst w - fst z) <= e -> Rabs (snd w - snd z) <= e -> Q w e) ->
  exists e, 0 < e /\ forall w, inside w Y -> forall v, Rabs (fst v - fst w) <= e -> Rabs (snd v - snd w) <= e -> Q v e.
Proof.
  intros Anti Loc.
  destruct (uniform (fun y e => forall x, xlo Y <= x <= xhi Y -> forall v, Rabs (fst v - x) <= e ->
    Rabs (snd v - y) <= e -> Q v e) (ylo Y) (yhi Y)) as [e [P H]].
  - intros y d e D K x X v Vx Vy. apply Anti with e; [exact D |]. apply (K x X v); lra.
  - intros y Hy.
    destruct (uniform (fun x e => forall v, Rabs (fst v - x) <= e -> Rabs (snd v - y) <= e -> Q v e)
      (xlo Y) (xhi Y)) as [e [P H]].
    + intros x d e D K v Vx Vy. apply Anti with e; [exact D |]. apply (K v); lra.
    + intros x Hx. destruct (Loc (x, y)) as [e [P H]]; [now split |]. simpl in H. exists (e / 2). split; [lra |].
      intros s S v Vx Vy. apply Anti with e; [lra |]. apply H; [| lra].
      replace (fst v - x) with ((fst v - s) + (s - x)) by ring.
      pose proof (Rabs_triang (fst v - s) (s - x)). lra.
    + exists (e / 2). split; [lra |]. intros s S x Hx v Vx Vy. apply Anti with e; [lra |]. apply (H x Hx v); [lra |].
      replace (snd v - y) with ((snd v - s) + (s - y)) by ring. pose proof (Rabs_triang (snd v - s) (s - y)). lra.
  - exists e. split; [exact P |]. intros w [Wx Wy] v Vx Vy. now apply (H (snd w) Wy (fst w) Wx v).
Qed.

Definition near_conic (e : R) (f g : conic) : Prop :=
  Rabs (ca f - ca g) <= e /\ Rabs (cb f - cb g) <= e /\ Rabs (cc f - cc g) <= e /\ Rabs (cd f - cd g) <= e.

(* Products of numbers that are near. *)
Lemma product_near M e u v u' v' : Rabs u <= M -> Rabs v' <= M -> Rabs (u' - u) <= e -> Rabs (v' - v) <= e ->
  Rabs (u' * v' - u * v) <= 2 * M * e.
Proof.
  intros U V Du Dv. replace (u' * v' - u * v) with ((u' - u) * v' + u * (v' - v)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult.
  pose proof (Rabs_pos u). pose proof (Rabs_pos v'). pose proof (Rabs_pos (u' - u)). pose proof (Rabs_pos (v' - v)).
  assert (Rabs (u' - u) * Rabs v' <= e * M) by (apply Rmult_le_compat; lra).
  assert (Rabs u * Rabs (v' - v) <= M * e) by (apply Rmult_le_compat; lra). lra.
Qed.

Lemma abs_near M e u u' : Rabs u <= M -> Rabs (u' - u) <= e -> Rabs u' <= M + e.
Proof.
  intros U D. replace u' with (u + (u' - u)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

(* The value of a conic at a point is continuous in both. *)
Lemma value_near g z s : 0 < s -> exists e, 0 < e /\ forall f w, near_conic e f g ->
  Rabs (fst w - fst z) <= e -> Rabs (snd w - snd z) <= e -> Rabs (value f w - value g z) < s.
Proof.
  intros S.
  set (M := 1 + Rabs (ca g) + Rabs (cb g) + Rabs (cc g) + Rabs (fst z) + Rabs (snd z)).
  pose proof (Rabs_pos (ca g)). pose proof (Rabs_pos (cb g)). pose proof (Rabs_pos (cc g)).
  pose proof (Rabs_pos (fst z)). pose proof (Rabs_pos (snd z)).
  assert (M1 : 1 <= M) by (unfold M; lra).
  set (c := 8 * M * M * M + 8 * M + 2). assert (C : 0 < c) by (unfold c; nra).
  set (e := Rmin 1 (s / c)). assert (E0 : 0 < e) by (apply Rmin_pos; [lra | now apply Rdiv_lt_0_compat]).
  assert (E1 : e <= 1) by apply Rmin_l.
  assert (Ec : c * e <= s).
  { assert (e <= s / c) by apply Rmin_r. apply Rle_trans with (c * (s / c)); [apply Rmult_le_compat_l; lra |].
    right. field. lra. }
  exists e. split; [exact E0 |]. intros f w [A [B [D G]]] X Y.
  assert (Xw : Rabs (fst w) <= M).
  { pose proof (abs_near (Rabs (fst z)) e _ _ (Rle_refl _) X). unfold M. lra. }
  assert (Yw : Rabs (snd w) <= M).
  { pose proof (abs_near (Rabs (snd z)) e _ _ (Rle_refl _) Y). unfold M. lra. }
  assert (Xz : Rabs (fst z) <= M) by (unfold M; lra). assert (Yz : Rabs (snd z) <= M) by (unfold M; lra).
  assert (Ag : Rabs (ca g) <= M) by (unfold M; lra). assert (Bg : Rabs (cb g) <= M) by (unfold M; lra).
  assert (Dg : Rabs (cc g) <= M) by (unfold M; lra).
  pose proof (product_near M e _ _ _ _ Xz Xw X X) as XX. pose proof (product_near M e _ _ _ _ Yz Yw Y Y) as YY.
  pose proof (product_near M e _ _ _ _ Bg Xw B X) as BX. pose proof (product_near M e _ _ _ _ Dg Yw D Y) as DY.
  assert (W : Rabs (dot w w - dot z z) <= 4 * M * e).
  { unfold dot. replace (fst w * fst w + snd w * snd w - (fst z * fst z + snd z * snd z))
      with ((fst w * fst w - fst z * fst z) + (snd w * snd w - snd z * snd z)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  assert (Ww : Rabs (dot w w) <= 2 * M * M).
  { unfold dot. apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult.
    pose proof (Rabs_pos (fst w)). pose proof (Rabs_pos (snd w)).
    assert (Rabs (fst w) * Rabs (fst w) <= M * M) by (apply Rmult_le_compat; lra).
    assert (Rabs (snd w) * Rabs (snd w) <= M * M) by (apply Rmult_le_compat; lra). lra. }
  assert (AW : Rabs (ca f * dot w w - ca g * dot z z) <= 6 * M * M * e).
  { replace (ca f * dot w w - ca g * dot z z) with ((ca f - ca g) * dot w w + ca g * (dot w w - dot z z)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult.
    assert (Rabs (ca f - ca g) * Rabs (dot w w) <= e * (2 * M * M))
      by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
    assert (Rabs (ca g) * Rabs (dot w w - dot z z) <= M * (4 * M * e))
      by (apply Rmult_le_compat; try apply Rabs_pos; assumption). lra. }
  unfold value.
  replace (ca f * dot w w + cb f * fst w + cc f * snd w + cd f - (ca g * dot z z + cb g * fst z + cc g * snd z + cd g))
    with ((ca f * dot w w - ca g * dot z z) + (cb f * fst w - cb g * fst z) + (cc f * snd w - cc g * snd z) + (cd f - cd g))
    by ring.
  apply abs_le in AW, BX, DY, G.
  assert (6 * M * M * e + 2 * M * e + 2 * M * e + e < c * e).
  { unfold c. assert (M * M <= M * M * M) by nra. assert (0 < M * M) by nra. nra. }
  apply Rabs_def1; lra.
Qed.

(* If a conic is negative on all of a rectangle, so are conics near it on all rectangles near it. *)
Lemma negative_persists g Y : (forall z, inside z Y -> value g z < 0) ->
  exists e, 0 < e /\ forall f X, near_conic e f g -> close e X Y -> forall z, inside z X -> value f z < 0.
Proof.
  intros H.
  destruct (uniform_rect (fun z e => forall f, near_conic e f g -> value f z < 0) Y) as [e [E G]].
  - intros z d e D K f [A [B [C F]]]. apply K. unfold near_conic. lra.
  - intros z Z. specialize (H z Z). destruct (value_near g z (- value g z)) as [e [E K]]; [lra |].
    exists e. split; [exact E |]. intros w Wx Wy f F. specialize (K f w F Wx Wy).
    apply Rabs_def2 in K. lra.
  - exists e. split; [exact E |]. intros f X F C z Z. destruct C as [C1 [C2 [C3 C4]]]. destruct Z as [Zx Zy].
    apply (G (nearest z Y) (nearest_inside z Y) z); [| | exact F]; unfold nearest; simpl.
    + apply clamp_near with (xlo X) (xhi X); [apply x_ordered | exact Zx | |]; rewrite Rabs_minus_sym; assumption.
    + apply clamp_near with (ylo X) (yhi X); [apply y_ordered | exact Zy | |]; rewrite Rabs_minus_sym; assumption.
Qed.

Definition opposite (g : conic) : conic := Conic (- ca g) (- cb g) (- cc g) (- cd g).

Lemma value_opposite g z : value (opposite g) z = - value g z.
Proof. unfold value, opposite. simpl. ring. Qed.

Lemma positive_persists g Y : (forall z, inside z Y -> 0 < value g z) ->
  exists e, 0 < e /\ forall f X, near_conic e f g -> close e X Y -> forall z, inside z X -> 0 < value f z.
Proof.
  intros H. destruct (negative_persists (opposite g) Y) as [e [E G]].
  { intros z Z. rewrite value_opposite. specialize (H z Z). lra. }
  exists e. split; [exact E |]. intros f X [A [B [C D]]] K z Z.
  assert (N : near_conic e (opposite f) (opposite g)).
  { unfold near_conic, opposite. simpl.
    assert (M : forall u v, Rabs (- u - - v) = Rabs (u - v)) by (intros; rewrite <- Rabs_Ropp; f_equal; ring).
    rewrite !M. tauto. }
  specialize (G (opposite f) X N K z Z). rewrite value_opposite in G. lra.
Qed.

(* Conics with coefficients of size 1, the discs and half-planes that show a pair as possible. *)
Definition size (g : conic) : R := Rabs (ca g) + Rabs (cb g) + Rabs (cc g) + Rabs (cd g).
Definition shows (N : nat) (B : sites) (i j : nat) (g : conic) : Prop :=
  0 <= ca g /\ size g = 1 /\
  (exists z, inside z (B i) /\ value g z <= 0) /\ (exists z, inside z (B j) /\ value g z <= 0) /\
  forall k, (k < N)%nat -> exists z, inside z (B k) /\ 0 <= value g z.

Lemma supported_weak_edge N p i j g : (i < N)%nat -> (j < N)%nat -> supports N p i j g -> weak_edge N p i j.
Proof.
  intros I J [G0 [G1 [Vi [Vj Vk]]]]. destruct (Req_dec (ca g) 0) as [Z | Z].
  - right. exists (- cb g, - cc g), (cd g). unfold value in Vi, Vj, Vk. rewrite Z in *. split; [| split].
    + intros E. injection E as E E'. destruct G1 as [G1 | [G1 | G1]]; [lra | apply G1; lra | apply G1; lra].
    + unfold dot in *. simpl. intros k _ [-> | ->]; lra.
    + unfold dot in *. simpl. intros k K. specialize (Vk k K). lra.
  - left. assert (P : 0 < ca g) by lra. set (c := (- cb g / (2 * ca g), - cc g / (2 * ca g))).
    assert (E : forall z, value g z = ca g * dist2 c z + (cd g - ca g * dot c c)).
    { intros z. unfold value, dist2, dot, c. simpl. field. lra. }
    assert (D : empty_disc N p (pair i j) c (dist c (p i))).
    { split.
      - intros k _ [-> | ->]; [reflexivity |]. apply dist_eq. rewrite E in Vi, Vj.
        apply (Rmult_eq_reg_l (ca g)); [| exact Z]. lra.
      - intros k K. apply dist_le. specialize (Vk k K). rewrite E in Vi, Vk.
        apply (Rmult_le_reg_l (ca g)); [exact P |]. lra. }
    destruct (Rle_lt_or_eq_dec 0 (dist c (p i)) (dist_nonneg _ _)) as [L | Z0].
    + now exists c, (dist c (p i)).
    + rewrite <- Z0 in D. destruct (positive_disc N p _ c D) as [c' [r [R0 D']]]. now exists c', r.
Qed.

Lemma zero_in_rect g Y a b : inside a Y -> inside b Y -> value g a <= 0 -> 0 <= value g b ->
  exists z, inside z Y /\ value g z = 0.
Proof.
  intros A B H G. destruct (intermediate (fun t => value g (mix t a b))) as [t [T E]].
  - unfold value, dot, mix. simpl. reg.
  - now rewrite mix_0.
  - now rewrite mix_1.
  - exists (mix t a b). split; [now apply inside_convex | exact E].
Qed.

Lemma shows_possible N B i j g : (i < N)%nat -> (j < N)%nat -> shows N B i j g -> possible N B i j.
Proof.
  intros I J [G0 [G1 [[a [Ia Va]] [[b [Ib Vb]] H]]]]. apply possible_exact; [exact I | exact J |].
  destruct (finite_choice (0, 0) (fun k z => inside z (B k) /\ 0 <= value g z /\ (pair i j k -> value g z = 0)) N)
    as [p P].
  { intros k K. destruct (H k K) as [z [Z V]]. destruct (classic (pair i j k)) as [Y | Y].
    - assert (X : exists w, inside w (B k) /\ value g w = 0).
      { destruct Y as [-> | ->]; [now apply zero_in_rect with a z | now apply zero_in_rect with b z]. }
      destruct X as [w [W E]]. exists w. split; [exact W |]. split; [lra | now intros].
    - exists z. split; [exact Z |]. split; [exact V | now intros]. }
  exists p. split; [intros k K; now apply P |]. apply supported_weak_edge with g; [exact I | exact J |].
  assert (Ei : value g (p i) = 0) by (apply (P i I); now left).
  split; [exact G0 |]. split.
  - apply NNPP. intros C. apply not_or_and in C as [C1 C]. apply not_or_and in C as [C2 C3].
    apply NNPP in C1, C2, C3. unfold size in G1. unfold value in Ei. rewrite C1, C2, C3, ?Rabs_R0 in *.
    assert (cd g = 0) by lra. rewrite H0, Rabs_R0 in G1. lra.
  - split; [exact Ei |]. split; [apply (P j J); now right |]. intros k K. now apply (P k K).
Qed.

Lemma possible_shows N B i j : (i < N)%nat -> (j < N)%nat -> possible N B i j -> exists g, shows N B i j g.
Proof.
  intros I J H. apply possible_exact in H as [p [P W]]; [| exact I | exact J].
  destruct (weak_edge_supported N p i j I J W) as [g [G0 [G1 [Vi [Vj Vk]]]]].
  assert (S : 0 < size g).
  { unfold size. pose proof (Rabs_pos (ca g)). pose proof (Rabs_pos (cb g)). pose proof (Rabs_pos (cc g)).
    pose proof (Rabs_pos (cd g)). destruct G1 as [G1 | [G1 | G1]]; apply Rabs_pos_lt in G1; lra. }
  set (q := / size g). assert (Q : 0 < q) by (now apply Rinv_0_lt_compat).
  exists (Conic (q * ca g) (q * cb g) (q * cc g) (q * cd g)).
  assert (V : forall z, value (Conic (q * ca g) (q * cb g) (q * cc g) (q * cd g)) z = q * value g z)
    by (intros z; unfold value; simpl; ring).
  split; [simpl; nra |]. split; [| split; [| split]].
  - unfold size. simpl. rewrite !Rabs_mult, (Rabs_pos_eq q) by lra.
    transitivity (q * size g); [unfold size; ring |]. unfold q. apply Rinv_l. lra.
  - exists (p i). split; [now apply P |]. rewrite V, Vi. lra.
  - exists (p j). split; [now apply P |]. rewrite V, Vj. lra.
  - intros k K. exists (p k). split; [now apply P |]. rewrite V. specialize (Vk k K). nra.
Qed.

Section Stream.
Variables (N : nat) (B : nat -> sites) (L : sites) (i j : nat).
Variables (HL : limit N B L) (I : (i < N)%nat) (J : (j < N)%nat).

(* e also bounds the stages: those after 1/e are meant. *)
Definition fails (g : conic) (e : R) : Prop := forall n, / e <= INR n -> ~ shows N (B n) i j g.

Lemma fails_weaken g d e : 0 < d <= e -> fails g e -> fails g d.
Proof.
  intros D H n Hn. apply H. apply Rle_trans with (/ d); [| exact Hn]. apply Rinv_le_contravar; lra.
Qed.

Lemma late_inverse (P : nat -> Prop) : late P -> exists e, 0 < e /\ forall n, / e <= INR n -> P n.
Proof.
  intros [m M]. exists (/ INR (S m)). assert (S0 : 0 < INR (S m)) by (apply lt_0_INR; lia).
  split; [now apply Rinv_0_lt_compat |]. intros n Hn. rewrite Rinv_inv in Hn. apply INR_le in Hn. apply M. lia.
Qed.

Definition locally_fails (g : conic) : Prop := exists e, 0 < e /\ forall f, near_conic e f g -> fails f e.

Lemma locally (g : conic) (k : nat) (T : conic -> rect -> Prop) : (k < N)%nat ->
  (exists e, 0 < e /\ forall f X, near_conic e f g -> close e X (L k) -> T f X) ->
  (forall f n, T f (B n k) -> ~ shows N (B n) i j f) -> locally_fails g.
Proof.
  intros K [e [E H]] F. destruct HL as [_ C]. destruct (late_inverse _ (C k e K E)) as [d [D G]].
  exists (Rmin e d). pose proof (Rmin_l e d). pose proof (Rmin_r e d). assert (0 < Rmin e d) by (now apply Rmin_pos).
  split; [assumption |]. intros f [F1 [F2 [F3 F4]]] n Hn. apply F. apply H; [unfold near_conic; lra |].
  apply G. apply Rle_trans with (2 := Hn). apply Rinv_le_contravar; lra.
Qed.

Lemma size_near e f g : near_conic e f g -> Rabs (size f - size g) <= 4 * e.
Proof.
  intros [A [C [D E]]]. unfold size.
  assert (T : forall u v, Rabs (u - v) <= e -> Rabs u - Rabs v <= e /\ Rabs v - Rabs u <= e).
  { intros u v U. pose proof (Rabs_triang_inv u v). pose proof (Rabs_triang_inv v u).
    rewrite (Rabs_minus_sym v u) in *. lra. }
  apply T in A, C, D, E. apply Rabs_le. lra.
Qed.

(* A conic that does not show the pair possible at the limit fails at all late stages, with all conics near it. *)
Lemma limit_fails_locally g : ~ shows N L i j g -> locally_fails g.
Proof.
  intros H. destruct (Rlt_dec (ca g) 0) as [A | A].
  { exists (- ca g / 2). split; [lra |]. intros f [F _] n _ [C _]. apply abs_le in F. lra. }
  destruct (Req_dec (size g) 1) as [Z | Z].
  2: { assert (P : 0 < Rabs (size g - 1)) by (apply Rabs_pos_lt; lra). exists (Rabs (size g - 1) / 8). split; [lra |].
       intros f F n _ [_ [C _]]. apply size_near in F. rewrite C, Rabs_minus_sym in F. lra. }
  destruct (classic (exists z, inside z (L i) /\ value g z <= 0)) as [Hi | Hi].
  2: { apply (locally g i (fun f X => forall z, inside z X -> 0 < value f z) I).
       - apply positive_persists. intros z W. apply Rnot_le_lt. intros V. apply Hi. now exists z.
       - intros f n F [_ [_ [[z [W V]] _]]]. specialize (F z W). lra. }
  destruct (classic (exists z, inside z (L j) /\ value g z <= 0)) as [Hj | Hj].
  2: { apply (locally g j (fun f X => forall z, inside z X -> 0 < value f z) J).
       - apply positive_persists. intros z W. apply Rnot_le_lt. intros V. apply Hj. now exists z.
       - intros f n F [_ [_ [_ [[z [W V]] _]]]]. specialize (F z W). lra. }
  destruct (classic (forall k, (k < N)%nat -> exists z, inside z (L k) /\ 0 <= value g z)) as [Hk | Hk].
  { exfalso. apply H. split; [lra |]. now repeat split. }
  apply not_all_ex_not in Hk as [k Hk]. apply imply_to_and in Hk as [K Hk].
  apply (locally g k (fun f X => forall z, inside z X -> value f z < 0) K).
  - apply negative_persists. intros z W. apply Rnot_le_lt. intros V. apply Hk. now exists z.
  - intros f n F [_ [_ [_ [_ G]]]]. destruct (G k K) as [z [W V]]. specialize (F z W). lra.
Qed.

(* Compactness in the four coefficients, one after the other. *)
Lemma fails_in_the_end : (forall g, ~ shows N L i j g) -> exists e, 0 < e /\ forall a b c d,
  -1 <= a <= 1 -> -1 <= b <= 1 -> -1 <= c <= 1 -> -1 <= d <= 1 -> fails (Conic a b c d) e.
Proof.
  intros H. set (nr e x y := Rabs (x - y) <= e).
  assert (Half : forall e x y s, Rabs (x - s) <= e / 2 -> Rabs (s - y) <= e / 2 -> Rabs (x - y) <= e).
  { intros e x y s P Q. replace (x - y) with ((x - s) + (s - y)) by ring.
    pose proof (Rabs_triang (x - s) (s - y)). lra. }
  destruct (uniform (fun a e => forall b c d,
    -1 <= b <= 1 -> -1 <= c <= 1 -> -1 <= d <= 1 -> fails (Conic a b c d) e) (-1) 1) as [e [E G]].
  { intros a d e D F b c x Hb Hc Hx. apply fails_weaken with e; auto. }
  2: { exists e. split; [exact E |]. intros a b c d Ha. now apply G. }
  intros a Ha.
  destruct (uniform (fun b e => forall a' c d, nr e a' a ->
    -1 <= c <= 1 -> -1 <= d <= 1 -> fails (Conic a' b c d) e) (-1) 1) as [e [E G]].
  { intros b d e D F a' c x Na Hc Hx. apply fails_weaken with e; auto. apply F; auto. unfold nr in *. lra. }
  2: { exists e. split; [exact E |]. intros s S b c d Hb Hc Hd. now apply G. }
  intros b Hb.
  destruct (uniform (fun c e => forall a' b' d, nr e a' a -> nr e b' b ->
    -1 <= d <= 1 -> fails (Conic a' b' c d) e) (-1) 1) as [e [E G]].
  { intros c d e D F a' b' x Na Nb Hx. apply fails_weaken with e; auto. apply F; auto; unfold nr in *; lra. }
  2: { exists e. split; [exact E |]. intros s S a' c d Na Hc Hd. now apply G. }
  intros c Hc.
  destruct (uniform (fun d e => forall a' b' c', nr e a' a -> nr e b' b -> nr e c' c ->
    fails (Conic a' b' c' d) e) (-1) 1) as [e [E G]].
  { intros d x e D F a' b' c' Na Nb Nc. apply fails_weaken with e; auto. apply F; unfold nr in *; lra. }
  2: { exists e. split; [exact E |]. intros s S a' b' d Na Nb Hd. now apply G. }
  intros d Hd. destruct (limit_fails_locally (Conic a b c d) (H _)) as [e [E G]]. exists e. split; [exact E |].
  intros s S a' b' c' Na Nb Nc. apply G. unfold near_conic, nr in *. simpl. tauto.
Qed.

(* A pair possible at every stage is possible at the limit: an illegal pair shows itself at some stage. *)
Theorem possible_limit : possible N L i j <-> forall n, possible N (B n) i j.
Proof.
  split.
  - intros H n. apply (possible_monotone N L (B n)); [exact I | exact J | now apply limit_refines | exact H].
  - intros H. apply NNPP. intros C.
    destruct fails_in_the_end as [e [E F]].
    { intros g G. apply C. now apply shows_possible with g. }
    destruct (archimed_cor1 e E) as [n [A Hn]].
    destruct (possible_shows N (B n) i j I J (H n)) as [g G].
    assert (Bd : -1 <= ca g <= 1 /\ -1 <= cb g <= 1 /\ -1 <= cc g <= 1 /\ -1 <= cd g <= 1).
    { destruct G as [_ [S _]]. unfold size in S. pose proof (Rabs_pos (ca g)). pose proof (Rabs_pos (cb g)).
      pose proof (Rabs_pos (cc g)). pose proof (Rabs_pos (cd g)).
      pose proof (abs_le (ca g) 1 ltac:(lra)). pose proof (abs_le (cb g) 1 ltac:(lra)).
      pose proof (abs_le (cc g) 1 ltac:(lra)). pose proof (abs_le (cd g) 1 ltac:(lra)). tauto. }
    destruct Bd as [Ba [Bb [Bc Bd]]]. destruct g as [a b c d]. simpl in *.
    apply (F a b c d Ba Bb Bc Bd n); [| exact G].
    assert (P : 0 < INR n) by (now apply lt_0_INR). rewrite <- (Rinv_inv (INR n)).
    apply Rinv_le_contravar; [now apply Rinv_0_lt_compat | lra].
Qed.
End Stream.
